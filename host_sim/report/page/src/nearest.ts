// SPDX-License-Identifier: MIT
// The place of the path that a click means.
import { Vector3 } from "three";
import type { Pieces } from "./pieces";

/** The time of the nearest place on the screen, within some pixels. @param between  heights */
export function nearest(pieces: Pieces, x: number, y: number, between: [number, number], onScreen: (at: Vector3) => [number, number]): number | undefined {
    const { xyz, time, drawn } = pieces;
    let best = 15 * 15;
    let found: number | undefined;
    const at = new Vector3();
    let [px, py] = [0, 0];
    for (let i = 0; i * 3 < xyz.length; ++i) {
        if (xyz[3 * i + 2] < between[0] - 1e-6 || xyz[3 * i + 2] > between[1] + 1e-6) continue;
        const [sx, sy] = onScreen(at.fromArray(xyz, 3 * i));
        if (i > 0 && drawn[i - 1]) {
            const [dx, dy] = [sx - px, sy - py];
            const length = dx * dx + dy * dy;
            const share = length > 0 ? Math.min(Math.max(((x - px) * dx + (y - py) * dy) / length, 0), 1) : 1;
            const distance = (px + share * dx - x) ** 2 + (py + share * dy - y) ** 2;
            if (distance < best) {
                best = distance;
                found = time[i - 1] + share * (time[i] - time[i - 1]);
            }
        }
        [px, py] = [sx, sy];
    }
    return found;
}
