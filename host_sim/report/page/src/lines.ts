// SPDX-License-Identifier: MIT
// The lines of a path: coloured ones, and dashed ones.
import { BufferAttribute, BufferGeometry, LineBasicMaterial, LineSegments, type Material, type Object3D } from "three";
import { LineMaterial } from "three/examples/jsm/lines/LineMaterial.js";
import { LineSegments2 } from "three/examples/jsm/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/examples/jsm/lines/LineSegmentsGeometry.js";
import type { Colouring, Pieces } from "./pieces";

const most_wide = 60000; // pieces that are drawn as wide lines
const most_wide_moving = 8000; // that stay wide while the picture moves
const most_moving = 10000; // that are drawn while the picture moves
const block = 64; // pieces that stay together then

export interface Coloured {
    all: Object3D[];
    some?: Object3D; // if all are too many to move
    beads: [LineMaterial, number][]; // lines as wide as so many millimetres
}

/** Lines of each width, where widths are known. */
function widths(chosen: number[], of?: Float32Array): Map<number, number[]> {
    const step = 1.12;
    const out = new Map<number, number[]>();
    for (let n = 0; n < chosen.length; ++n) {
        const width = of ? step ** Math.round(Math.log(of[chosen[n]]) / Math.log(step)) : 0;
        const same = out.get(width);
        if (same) same.push(n);
        else out.set(width, [n]);
    }
    return out;
}

/** The chosen pieces. @param wide  the width of each piece [mm] */
export function coloured(pieces: Pieces, colouring: Colouring, chosen: number[], prepare: <M extends Material>(material: M) => M, wide?: Float32Array): Coloured {
    const ends = new Float32Array(6 * chosen.length);
    const colours = new Float32Array(6 * chosen.length);
    const linear = colouring.table.map((colour) => colour.map((c) => (c < 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4))); // as three blends them
    chosen.forEach((i, n) => {
        const colour = linear[colouring.of[i]];
        for (let k = 0; k < 6; ++k) {
            ends[6 * n + k] = pieces.xyz[3 * i + k];
            colours[6 * n + k] = colour[k % 3];
        }
    });
    const all: Object3D[] = [];
    const beads: [LineMaterial, number][] = [];
    if (chosen.length <= most_wide) {
        for (const [width, members] of widths(chosen, wide)) {
            const part = (values: Float32Array) => (members.length === chosen.length ? values : Float32Array.from({ length: 6 * members.length }, (_, i) => values[6 * members[Math.floor(i / 6)] + (i % 6)]));
            const geometry = new LineSegmentsGeometry();
            geometry.setPositions(part(ends));
            geometry.setColors(part(colours));
            const material = prepare(new LineMaterial({ vertexColors: true, linewidth: 2.6 }));
            if (width > 0) beads.push([material, width]);
            all.push(new LineSegments2(geometry, material));
        }
        if (chosen.length <= most_wide_moving) return { all, beads };
    }
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(ends, 3));
    geometry.setAttribute("color", new BufferAttribute(colours, 3));
    const material = prepare(new LineBasicMaterial({ vertexColors: true }));
    const every = Math.ceil(chosen.length / most_moving);
    const some: number[] = [];
    for (let n = 0; n < chosen.length; ++n) if (Math.floor(n / block) % every === 0) some.push(2 * n, 2 * n + 1);
    const part = new BufferGeometry().setIndex(some);
    for (const name of ["position", "color"]) part.setAttribute(name, geometry.getAttribute(name));
    const drawn = [geometry, part].map((of) => new LineSegments(of, material));
    for (const lines of drawn) lines.frustumCulled = false; // its sphere takes long to find
    return { all: all.length ? all : [drawn[0]], some: drawn[1], beads };
}

/** Dashes that run on from piece to piece. @param ends x, y, z of the begin and of the end of each piece */
export function dashed(ends: number[], dash: number, material: LineMaterial): LineSegments2 {
    const geometry = new LineSegmentsGeometry().setPositions(ends);
    material.dashSize = material.gapSize = dash;
    const lines = new LineSegments2(geometry, material);
    lines.computeLineDistances();
    const distance = geometry.getAttribute("instanceDistanceStart") as unknown as { data: { array: Float32Array } };
    let way = 0;
    for (let i = 0; i < ends.length; i += 6) {
        distance.data.array[i / 3] = way;
        way += Math.hypot(ends[i + 3] - ends[i], ends[i + 4] - ends[i + 1], ends[i + 5] - ends[i + 2]);
        distance.data.array[i / 3 + 1] = way;
    }
    return lines;
}
