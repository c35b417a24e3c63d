// SPDX-License-Identifier: MIT
// Bins of time as a strip draws them: each by itself, or groups of many.
import type { Bins } from "./data";
import { before } from "./motion";

const most = 2000; // that are drawn one by one
const groups = 700; // of more: about one for each pixel or two

/** Bins that are drawn as one, up to `last`. */
export interface Group {
    first: number;
    last: number;
    whole: boolean; // else it is a bin
}

/** Those of a range. @param edges  where bins begin, and where the last one ends */
export function grouped(edges: Float64Array, range: [number, number]): Group[] {
    const first = Math.max(before(edges, range[0]) - 1, 0);
    const last = Math.min(before(edges, range[1]) + 2, edges.length - 1);
    const size = last - first > most ? Math.ceil((last - first) / groups) : 1;
    const out: Group[] = [];
    for (let i = first; i < last; i += size) out.push({ first: i, last: Math.min(i + size, last), whole: size > 1 });
    return out;
}

/** The two values of each bin, in the order in which the curve goes on; of a group the mean. */
export function curve(of: Bins, channel: number, factor: number, bins: Group[]): number[] {
    const [low, high] = [of.low[channel], of.high[channel]];
    return bins.flatMap(({ first, last, whole }) => {
        if (whole) {
            let sum = 0;
            for (let i = first; i < last; ++i) sum += low[i] + high[i];
            return [(0.5 * factor * sum) / (last - first)];
        }
        const rises = (low[first + 1] ?? 0) + (high[first + 1] ?? 0) >= (low[first - 1] ?? 0) + (high[first - 1] ?? 0);
        const ends = [factor * low[first], factor * high[first]];
        return rises ? ends : ends.reverse();
    });
}

/** The extremes of groups; nothing: they are no groups. */
export function extremes(of: Bins, channel: number, factor: number, bins: Group[]): [(number | null)[], (number | null)[]] {
    if (!bins[0]?.whole) return [Array(2 * bins.length).fill(null), Array(2 * bins.length).fill(null)];
    const pick = (values: Float64Array, least: boolean) =>
        bins.map(({ first, last }) => factor * values.subarray(first, last).reduce((a, b) => (least ? Math.min(a, b) : Math.max(a, b))));
    return [pick(of.low[channel], true), pick(of.high[channel], false)];
}

/** Of groups the mean of the larger one of the extremes in each bin. */
export function sizes(of: Bins, channel: number, factor: number, bins: Group[]): number[] {
    return bins.map(({ first, last }) => {
        let sum = 0;
        for (let i = first; i < last; ++i) sum += Math.max(of.high[channel][i], -of.low[channel][i]);
        return (factor * sum) / (last - first);
    });
}
