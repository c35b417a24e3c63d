// SPDX-License-Identifier: MIT
// Programs that rise in layers: printed and milled ones.
import { Kind, type Motion } from "./motion";

export interface Layer {
    z: number;
    start: number;
    seconds: number;
}

/** Levels of feed at one height, each above the one before. Empty: the program does not rise like this. */
export function layers(motion: Motion): Layer[] {
    const { path } = motion.report;
    const height = motion.space[2] >= 0 ? path.position[motion.space[2]] : undefined;
    if (!height) return [];
    const found: Layer[] = [];
    let level = 0;
    let all = 0;
    const same = 4 * path.tolerance + 1e-6;
    for (let i = 1; i < path.count; ++i) {
        if (path.kind[i] !== Kind.feed) continue;
        const seconds = path.time[i] - path.time[i - 1];
        all += seconds;
        if (Math.abs(height[i] - height[i - 1]) > same) continue;
        level += seconds;
        const last = found[found.length - 1];
        if (!last || height[i] > last.z + 2 * same) found.push({ z: height[i], start: path.time[i - 1], seconds: 0 });
        const of = found[found.length - 1];
        if (height[i] < of.z - 2 * same) return [];
        of.seconds += seconds;
    }
    return found.length >= 3 && level > 0.8 * all ? found : [];
}
