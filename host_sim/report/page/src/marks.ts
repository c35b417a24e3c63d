// SPDX-License-Identifier: MIT
// Marks of one size on the screen, and arrows along the path.
import { BufferAttribute, BufferGeometry, CanvasTexture, DynamicDrawUsage, Points, PointsMaterial, Vector3 } from "three";
import { LineSegmentsGeometry } from "three/examples/jsm/lines/LineSegmentsGeometry.js";
import type { Pieces } from "./pieces";

export function mark(shape: "disc" | "ring" | "square" | "diamond" | "cross", colour: string, edge: string): CanvasTexture {
    const canvas = document.createElement("canvas");
    canvas.width = canvas.height = 64;
    const draw = canvas.getContext("2d")!;
    draw.lineWidth = 8;
    draw.fillStyle = colour;
    draw.strokeStyle = edge;
    draw.beginPath();
    if (shape === "disc" || shape === "ring") draw.arc(32, 32, 22, 0, 7);
    if (shape === "square") draw.rect(13, 13, 38, 38);
    if (shape === "diamond") [[32, 6], [58, 32], [32, 58], [6, 32]].forEach(([x, y]) => draw.lineTo(x, y));
    if (shape === "cross") {
        draw.moveTo(10, 10), draw.lineTo(54, 54), draw.moveTo(54, 10), draw.lineTo(10, 54);
        draw.lineWidth = 12;
        draw.strokeStyle = colour;
    }
    draw.closePath();
    if (shape !== "ring" && shape !== "cross") draw.fill();
    if (shape === "ring") draw.strokeStyle = colour;
    draw.stroke();
    return new CanvasTexture(canvas);
}

/** @param size in pixels of the device */
export function points(places: number[][], texture: CanvasTexture, size: number): Points {
    const geometry = new BufferGeometry();
    const attribute = new BufferAttribute(new Float32Array(places.flat()), 3);
    attribute.setUsage(DynamicDrawUsage);
    geometry.setAttribute("position", attribute);
    const material = new PointsMaterial({ map: texture, size, sizeAttenuation: false, transparent: true, depthTest: false });
    const made = new Points(geometry, material);
    made.frustumCulled = false;
    made.renderOrder = 10;
    return made;
}

/** Directions, at equal lengths of the path; nothing: it has no length. */
export function arrows(pieces: Pieces, size: number): LineSegmentsGeometry | undefined {
    const { xyz, drawn, count } = pieces;
    let all = 0;
    const lengths = new Float64Array(count);
    for (let i = 0; i < count; ++i) {
        const [a, b] = [3 * i, 3 * i + 3];
        all += Math.hypot(xyz[b] - xyz[a], xyz[b + 1] - xyz[a + 1], xyz[b + 2] - xyz[a + 2]);
        lengths[i] = all;
    }
    const wings: number[] = [];
    const most = 14;
    for (let n = 0, i = 0; n < most && all > 0; ++n) {
        while (i + 1 < count && (lengths[i] < ((n + 0.5) / most) * all || !drawn[i])) ++i;
        const tip = new Vector3().fromArray(xyz, 3 * i + 3);
        const ahead = tip.clone().sub(new Vector3().fromArray(xyz, 3 * i)).normalize();
        const across = new Vector3(-ahead.y, ahead.x, 0);
        if (across.lengthSq() < 1e-9) across.set(1, 0, 0);
        across.normalize().multiplyScalar(0.009 * size);
        const back = tip.clone().addScaledVector(ahead, -0.022 * size);
        for (const side of [1, -1]) wings.push(...tip.toArray(), ...back.clone().addScaledVector(across, side).toArray());
    }
    return wings.length ? new LineSegmentsGeometry().setPositions(wings) : undefined;
}
