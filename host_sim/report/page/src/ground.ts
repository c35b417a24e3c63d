// SPDX-License-Identifier: MIT
// What the path is seen against: a grid with its ticks, the travel of the machine and the zero of the work; and a tool.
import { BufferAttribute, BufferGeometry, DoubleSide, LineBasicMaterial, LineSegments, Mesh, MeshBasicMaterial, Vector3 } from "three";
import { axisColour, niceStep, tick } from "./colour";
import type { Motion } from "./motion";

export interface Tick {
    at: Vector3;
    text: string;
    title: boolean;
}

export function segments(ends: number[], color: number | string): LineSegments {
    const geometry = new BufferGeometry().setAttribute("position", new BufferAttribute(new Float32Array(ends), 3));
    return new LineSegments(geometry, new LineBasicMaterial({ color }));
}

/** A grid at the foot of the box, and where its labels stand. */
export function grid(motion: Motion, low: Vector3, high: Vector3, color: number): { lines: LineSegments; ticks: Tick[] } {
    const size = Math.max(...high.clone().sub(low).toArray(), 1e-6);
    const step = niceStep(Math.max(high.x - low.x, high.y - low.y, size / 6), 8);
    const floor = (v: number) => Math.floor(v / step - 1e-9) * step;
    const ceil = (v: number) => Math.ceil(v / step + 1e-9) * step;
    const [x0, x1, y0, y1] = [floor(low.x), ceil(high.x), floor(low.y), ceil(high.y)];
    const z = low.z;
    const ends: number[] = [];
    const ticks: Tick[] = [];
    const axis = (k: number) => motion.report.machine.axes[motion.space[k]];
    const label = (x: number, y: number, height: number, text: string, title = false) => ticks.push({ at: new Vector3(x, y, height), text, title });
    for (let i = 0; x0 + i * step <= x1 + 1e-9; ++i) {
        const x = x0 + i * step;
        ends.push(x, y0, z, x, y1, z);
        if (axis(0)) label(x, y0 - 0.35 * step, z, tick(x, step));
    }
    for (let i = 0; y0 + i * step <= y1 + 1e-9; ++i) {
        const y = y0 + i * step;
        ends.push(x0, y, z, x1, y, z);
        if (axis(1)) label(x0 - 0.35 * step, y, z, tick(y, step));
    }
    if (axis(0)) label(x1 + 0.9 * step, y0 - 0.35 * step, z, `${axis(0).name} [${axis(0).unit}]`, true);
    if (axis(1)) label(x0 - 0.35 * step, y1 + 0.4 * step, z, `${axis(1).name} [${axis(1).unit}]`, true);
    if (axis(2) && high.z - z > 0.02 * size) {
        const up = niceStep(high.z - z, 4);
        ends.push(x0, y1, z, x0, y1, high.z);
        for (let v = Math.ceil(z / up - 1e-9) * up; v <= high.z + 1e-9; v += up) label(x0 - 0.35 * step, y1, v, tick(v, up));
        label(x0 - 0.35 * step, y1, high.z + 0.45 * up, `${axis(2).name} [${axis(2).unit}]`, true);
    }
    return { lines: segments(ends, color), ticks };
}

/** The eight corners of the travel; none: an axis has no ends. */
export function travelCorners(motion: Motion): Vector3[] {
    const box = motion.space.map((k) => (k >= 0 ? motion.report.machine.axes[k].travel : ([0, 0] as [number, number])));
    if (box.some((range) => !range)) return [];
    return Array.from({ length: 8 }, (_, corner) => new Vector3(...[0, 1, 2].map((k) => box[k]![(corner >> k) & 1])));
}

/** The edges of the travel. */
export function travelBox(corners: Vector3[], color: string): LineSegments | undefined {
    if (!corners.length) return undefined;
    const at = (corner: number) => corners[corner].toArray();
    const ends: number[] = [];
    for (let corner = 0; corner < 8; ++corner) {
        for (const bit of [1, 2, 4]) if (!(corner & bit)) ends.push(...at(corner), ...at(corner | bit));
    }
    return segments(ends, color);
}

/** The axes of the work, at its zero. */
export function workZero(motion: Motion, length: number): LineSegments[] {
    const { axes } = motion.report.machine;
    const zero = motion.place(axes.map(({ name }) => motion.report.summary.zero_mm?.[name] ?? 0));
    return motion.space.flatMap((axis, k) => {
        if (axis < 0) return [];
        const end = zero.map((value, i) => value + (i === k ? length : 0));
        return [segments([...zero, ...end], axisColour(axes[axis].name, axis))];
    });
}

/** A tool that stands on the path: its tip is at 0. */
export function toolCone(size: number): Mesh {
    const corners: number[] = [];
    const sides = 20;
    const rim = (i: number) => [0.3 * size * Math.cos((2 * Math.PI * i) / sides), 0.3 * size * Math.sin((2 * Math.PI * i) / sides), size];
    for (let i = 0; i < sides; ++i) corners.push(0, 0, 0, ...rim(i), ...rim(i + 1), 0, 0, size, ...rim(i), ...rim(i + 1));
    const geometry = new BufferGeometry().setAttribute("position", new BufferAttribute(new Float32Array(corners), 3));
    return new Mesh(geometry, new MeshBasicMaterial({ color: "#e69f00", transparent: true, opacity: 0.3, side: DoubleSide, depthWrite: false }));
}
