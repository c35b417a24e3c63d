// SPDX-License-Identifier: MIT
// The renderer of the path in space.
import { BufferGeometry, CanvasTexture, Line, LineBasicMaterial, OrthographicCamera, Scene, WebGLRenderer } from "three";
import { LineMaterial } from "three/examples/jsm/lines/LineMaterial.js";
import { LineSegments2 } from "three/examples/jsm/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/examples/jsm/lines/LineSegmentsGeometry.js";
import { points } from "./marks";

/** Its programs are compiled while the page goes on. */
export function preparedRenderer(): WebGLRenderer {
    const renderer = new WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
    renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    renderer.localClippingEnabled = true;
    renderer.debug.checkShaderErrors = false; // the page would wait
    const scene = new Scene();
    for (const options of [{ vertexColors: true }, { dashed: true }, {}]) {
        scene.add(new LineSegments2(new LineSegmentsGeometry(), new LineMaterial(options)));
    }
    for (const vertexColors of [true, false]) scene.add(new Line(new BufferGeometry(), new LineBasicMaterial({ vertexColors })));
    scene.add(points([], new CanvasTexture(document.createElement("canvas")), 1));
    renderer.compile(scene, new OrthographicCamera());
    return renderer;
}
