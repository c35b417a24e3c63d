// SPDX-License-Identifier: MIT
// The path in space: drawn by three, turned by the mouse, picked by a click.
import {
    BufferAttribute, BufferGeometry, CanvasTexture, Color, Group, Line, LineBasicMaterial, Material, Object3D,
    OrthographicCamera, Plane, Points, Scene, Vector3, WebGLRenderer,
} from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { LineMaterial } from "three/examples/jsm/lines/LineMaterial.js";
import { LineSegments2 } from "three/examples/jsm/lines/LineSegments2.js";
import { Kind, type Motion } from "./motion";
import { nearest } from "./nearest";
import { beads, colouring, divide, type Colouring, type Pieces, type Quantity } from "./pieces";
import { el } from "./dom";
import { grid, toolCone, travelBox, travelCorners, workZero, type Tick } from "./ground";
import { coloured, dashed, type Coloured } from "./lines";
import { arrows, mark, points } from "./marks";

export type View = "free" | "top" | "front" | "side";
const directions: Record<View, [number, number, number]> = {
    free: [-0.55, -1, 0.75],
    top: [0, -1e-4, 1],
    front: [0, -1, 0],
    side: [1, 0, 0],
};
const pause_ms = 250; // without a move: all are drawn

export class Space {
    readonly element = el("div", { class: "space" });
    readonly pieces: Pieces;
    private readonly programmed: Float32Array; // x, y, z of each point
    quantity: Quantity = "speed";
    coloured!: Colouring;
    onPick: (t: number) => void = () => {};
    /** What lies over the picture: no label goes there. */
    covers: HTMLElement[] = [];

    private readonly scene = new Scene();
    private readonly camera = new OrthographicCamera();
    private readonly controls: OrbitControls;
    private readonly labels = el("div", { class: "labels" });
    private readonly tool = el("i", { class: "tool" });
    private readonly ghost = el("i", { class: "ghost" });
    private readonly places = { tool: new Vector3(), ghost: new Vector3() };
    private readonly low = new Vector3(Infinity, Infinity, Infinity);
    private readonly high = new Vector3(-Infinity, -Infinity, -Infinity);
    private readonly groups: Record<string, Group> = {};
    private readonly planes = [new Plane(new Vector3(0, 0, 1), 1e9), new Plane(new Vector3(0, 0, -1), 1e9)];
    private lines: Coloured = { all: [], beads: [] }; // of the path
    private readonly widths?: Float32Array; // of its pieces
    private readonly corners: Vector3[]; // of the travel
    private rest = 0; // a timer, while the picture moves
    private held = false; // by the pointer
    private clipped = false; // by the planes
    private ticks: Tick[] = [];
    private dark = false;
    private asked = false;
    private size = 1;
    private frame = { width: 1, height: 1 };

    /** Whether the path lies in the plane of x and y. */
    get flat(): boolean {
        return this.high.z - this.low.z < 1e-6 * this.size;
    }

    constructor(private readonly motion: Motion, private readonly renderer: WebGLRenderer) {
        this.pieces = divide(motion);
        const { programmed } = motion.report;
        const axes = motion.space.map((k) => programmed.position[k]);
        this.programmed = Float32Array.from({ length: 3 * programmed.count }, (_, i) => axes[i % 3]?.[Math.floor(i / 3)] ?? 0);
        this.measure();
        this.widths = beads(motion, this.pieces);
        this.corners = travelCorners(motion);
        this.element.append(this.renderer.domElement, this.labels, el("div", { class: "labels" }, this.ghost, this.tool));
        this.hover(-1);
        this.camera.up.set(0, 0, 1);
        this.controls = new OrbitControls(this.camera, this.renderer.domElement);
        this.controls.zoomToCursor = true;
        this.controls.addEventListener("change", () => this.moves());
        this.controls.addEventListener("start", () => (this.held = true));
        this.controls.addEventListener("end", () => ((this.held = false), this.moves()));
        for (const name of ["ground", "travel", "zero", "programmed", "rapids", "path", "arrows", "points", "stops", "marks", "tool"]) {
            this.scene.add((this.groups[name] = new Group()));
        }
        new ResizeObserver(() => this.resize()).observe(this.element);
        this.listen();
    }

    /** Whether waypoints do not cover the path. */
    get sparse(): boolean {
        return (this.motion.report.waypoints[0]?.length ?? 0) <= 150;
    }

    /** Builds everything for a ground that is light or dark. */
    dress(dark: boolean): void {
        this.dark = dark;
        const ink = dark ? "#e8eaed" : "#202124";
        const faint = dark ? "#5f6368" : "#9aa0a6";
        const ground = dark ? "#15181c" : "#ffffff";
        this.renderer.setClearColor(new Color(ground));
        for (const group of Object.values(this.groups)) group.clear();
        const { lines, ticks } = grid(this.motion, this.low, this.high, dark ? 0x2b3036 : 0xe4e7ea);
        this.ticks = ticks;
        this.add("ground", lines);
        this.add("travel", travelBox(this.corners, faint));
        for (const axis of workZero(this.motion, 0.14 * this.size)) this.add("zero", axis);
        if (this.motion.space[2] >= 0) this.add("tool", toolCone(0.09 * this.size));
        this.drawProgrammed(dark ? "#8f979f" : "#7d858c");
        this.paint(this.quantity);
        const { waypoints } = this.motion.report;
        const dots = Array.from({ length: waypoints[0]?.length ?? 0 }, (_, i) => [...this.motion.place(waypoints.map((axis) => axis[i]))]);
        this.marks("points", dots, mark("disc", ground, ink), 6.5);
        this.groups.points.visible &&= this.sparse;
        this.drawRapids(dark ? "#8a9199" : "#8d949b");
        this.drawMarks(ink, ground);
        this.draw();
    }

    paint(quantity: Quantity): void {
        this.quantity = quantity;
        this.coloured = colouring(this.motion, this.pieces, quantity, this.dark);
        this.drawPath();
    }

    private drawPath(): void {
        const { kind } = this.motion.report.path;
        const { xyz, drawn, knot, count } = this.pieces;
        const [low, high] = this.between;
        const chosen: number[] = [];
        for (let i = 0; i < count; ++i) {
            if (!drawn[i] || kind[knot[i]] === Kind.rapid || this.travels(i)) continue;
            if (xyz[3 * i + 5] >= low && xyz[3 * i + 5] <= high) chosen.push(i);
        }
        this.lines = coloured(this.pieces, this.coloured, chosen, (material) => material, this.widths);
        this.element.dataset.beads = this.lines.beads.map(([, width]) => width.toFixed(3)).join(" ");
        this.groups.path.clear();
        for (const object of [...this.lines.all, this.lines.some]) this.add("path", object);
        this.moves();
    }

    private get between(): [number, number] {
        return [-this.planes[0].constant, this.planes[1].constant];
    }

    /** Whether a print extrudes nothing on a piece. */
    private travels(i: number): boolean {
        return this.widths !== undefined && !(this.widths[i] > 0);
    }

    show(name: string, visible: boolean): void {
        this.groups[name].visible = visible;
        if (name === "travel") this.fit();
        this.draw();
    }

    /** Only what lies between two heights. */
    layers(low: number, high: number): void {
        this.planes[0].constant = -low;
        this.planes[1].constant = high;
        this.clipped = low > -1e9 || high < 1e9;
        for (const name of ["programmed", "rapids", "arrows"]) {
            this.groups[name].traverse((object) => {
                if (object instanceof Line || object instanceof LineSegments2) this.material(object.material);
            });
        }
        if (this.coloured) this.drawPath();
    }

    look(view: View): void {
        const target = this.low.clone().add(this.high).multiplyScalar(0.5);
        this.controls.target.copy(target);
        this.camera.position.copy(target).addScaledVector(new Vector3(...directions[view]).normalize(), 4 * this.size);
        this.camera.zoom = 1;
        this.camera.lookAt(target);
        this.fit();
        this.controls.update();
        this.draw();
    }

    moveTo(t: number): void {
        this.places.tool.set(...this.motion.place(this.motion.position(t)));
        for (const cone of this.groups.tool.children) cone.position.copy(this.places.tool);
        this.drawCursors();
        if (this.groups.tool.visible) this.draw();
    }

    /** Where the pointer is in a strip; below 0: in none. */
    hover(t: number): void {
        this.ghost.hidden = t < 0;
        if (t >= 0) this.places.ghost.set(...this.motion.place(this.motion.position(t)));
        this.drawCursors();
    }

    /** The picture moves: if it is large, some of it is drawn until it rests. */
    private moves(): void {
        if (this.lines.some) {
            clearTimeout(this.rest);
            if (!this.held) this.rest = window.setTimeout(() => this.thin(false), pause_ms);
        }
        this.thin(this.lines.some !== undefined);
    }

    private thin(thin: boolean): void {
        for (const object of this.lines.all) object.visible = !thin;
        if (this.lines.some) this.lines.some.visible = thin;
        const [line] = this.groups.programmed.children;
        if (line) line.visible = !thin;
        this.element.dataset.drawn = thin ? "some" : "all";
        this.draw();
    }

    private add(group: string, object?: Object3D): void {
        if (object) this.groups[group].add(object);
    }

    private marks(group: string, places: number[][], texture: CanvasTexture, size: number): Points {
        const made = points(places, texture, size * this.renderer.getPixelRatio());
        this.add(group, made);
        return made;
    }

    private material<M extends Material>(material: M): M {
        material.clippingPlanes = this.clipped ? this.planes : null; // another program of the renderer
        return material;
    }

    private measure(): void {
        for (const xyz of [this.pieces.xyz, this.programmed]) {
            const low = [Infinity, Infinity, Infinity];
            const high = low.map((v) => -v);
            for (let i = 0; i < xyz.length; ++i) {
                low[i % 3] = Math.min(low[i % 3], xyz[i]);
                high[i % 3] = Math.max(high[i % 3], xyz[i]);
            }
            this.low.min(new Vector3(...low));
            this.high.max(new Vector3(...high));
        }
        if (!Number.isFinite(this.low.x)) this.low.set(0, 0, 0), this.high.set(1, 1, 1);
        this.size = Math.max(...this.high.clone().sub(this.low).toArray(), 1e-6);
    }

    private resize(): void {
        const { clientWidth: w, clientHeight: h } = this.element;
        if (!w || !h) return;
        this.frame = { width: w, height: h };
        this.renderer.setSize(w, h);
        this.fit();
        this.draw();
    }

    /** The whole path on the screen at zoom 1. */
    private fit(): void {
        const { clientWidth: w, clientHeight: h } = this.element;
        if (!w || !h) return;
        this.camera.updateMatrixWorld();
        const inverse = this.camera.matrixWorldInverse;
        const centre = this.low.clone().add(this.high).multiplyScalar(0.5).applyMatrix4(inverse);
        const { xyz } = this.pieces;
        const stride = 3 * Math.max(1, Math.floor(xyz.length / 3 / 20000));
        const at = new Vector3();
        let [x, y] = [0, 0];
        const cover = () => {
            at.applyMatrix4(inverse);
            x = Math.max(x, Math.abs(at.x - centre.x));
            y = Math.max(y, Math.abs(at.y - centre.y));
        };
        for (let i = 0; i < xyz.length; i += stride) {
            at.fromArray(xyz, i);
            cover();
        }
        for (const place of [...this.ticks.map((tick) => tick.at), ...(this.groups.travel.visible ? this.corners : [])]) {
            at.copy(place);
            cover();
        }
        const room = (pixels: number, of: number) => Math.max(1 - pixels / of, 0.3); // of labels and, above, of what lies there
        const half = Math.max(y / room(76, h), (x / room(60, w)) * (h / w), 1e-6);
        this.camera.top = half;
        this.camera.bottom = -half;
        this.camera.right = (half * w) / h;
        this.camera.left = -this.camera.right;
        this.camera.near = -20 * this.size;
        this.camera.far = 40 * this.size;
        this.camera.updateProjectionMatrix();
    }

    draw(): void {
        if (this.asked) return;
        this.asked = true;
        requestAnimationFrame(() => this.render());
    }

    private render(): void {
        this.asked = false;
        const pixels = (this.frame.height * this.camera.zoom) / (this.camera.top - this.camera.bottom); // of a millimetre
        for (const [material, width] of this.lines.beads) material.linewidth = Math.max(width * pixels, 1.2);
        this.renderer.render(this.scene, this.camera);
        this.drawLabels();
        this.drawCursors();
    }

    /** At once, all of it, in the size that its element has now. */
    snap(): void {
        this.resize();
        this.thin(false);
        this.render();
    }

    private drawCursors(): void {
        for (const name of ["ghost", "tool"] as const) {
            const [x, y] = this.onScreen(this.places[name]);
            this[name].style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px)`;
            this.element.dataset[name] = `${x.toFixed(1)} ${y.toFixed(1)}`;
        }
    }

    private drawProgrammed(colour: string): void {
        const geometry = new BufferGeometry().setAttribute("position", new BufferAttribute(this.programmed, 3));
        const line = new Line(geometry, this.material(new LineBasicMaterial({ color: colour })));
        line.frustumCulled = false;
        this.groups.programmed.add(line);
    }

    private drawRapids(colour: string): void {
        const { kind } = this.motion.report.path;
        const ends: number[] = [];
        for (let i = 0; i < this.pieces.count; ++i) {
            const of = kind[this.pieces.knot[i]];
            if (this.pieces.drawn[i] && (of === Kind.rapid || of === Kind.approach || this.travels(i))) {
                ends.push(...this.pieces.xyz.subarray(3 * i, 3 * i + 6));
            }
        }
        if (ends.length) this.add("rapids", dashed(ends, this.size / 110, this.material(new LineMaterial({ color: colour, linewidth: 1.4, dashed: true }))));
    }

    private drawMarks(ink: string, ground: string): void {
        const { motion } = this;
        const { report } = motion;
        const at = (t: number) => [...motion.place(motion.position(t))];
        const inner = report.stops.filter((stop) => stop.why !== "end" && stop.why !== "held");
        this.marks("stops", inner.map((stop) => [...motion.place(stop.position)]), mark("ring", "#d55e00", ground), 11);
        const tools = report.events.filter((event) => event.what === "change_tool" || event.what === "set_tool");
        this.marks("marks", tools.map((event) => at(event.t)), mark("diamond", "#cc79a7", ink), 15);
        this.marks("marks", report.operated.map((done) => at(done.t)), mark("square", "#e69f00", ink), 12);
        if (report.path.count) {
            this.marks("marks", [at(0)], mark("disc", "#009e73", ground), 15);
            const end = mark(report.stopped ? "cross" : "square", report.stopped ? "#d55e00" : "#0072b2", ground);
            this.marks("marks", [at(motion.end)], end, (report.stopped ? 22 : 14));
        }
        const heads = arrows(this.pieces, this.size);
        if (heads) this.add("arrows", new LineSegments2(heads, this.material(new LineMaterial({ color: ink, linewidth: 1.3 }))));
    }

    private readonly projected = new Vector3();
    private onScreen(at: Vector3): [number, number] {
        const { width: w, height: h } = this.frame;
        const p = this.projected.copy(at).project(this.camera);
        return [((p.x + 1) / 2) * w, ((1 - p.y) / 2) * h];
    }

    /** Those that would cover another one are left out. */
    private drawLabels(): void {
        const { clientWidth: w, clientHeight: h } = this.element;
        const frame = this.element.getBoundingClientRect();
        const taken = this.covers.map((cover) => {
            const box = cover.getBoundingClientRect();
            return [box.left - frame.left, box.top - frame.top, box.right - frame.left, box.bottom - frame.top];
        });
        const shown = [...this.ticks].sort((a, b) => Number(b.title) - Number(a.title)).flatMap(({ at, text, title }) => {
            const [x, y] = this.onScreen(at);
            const half = 3.6 * text.length + 3;
            const box = [x - half, y - 8, x + half, y + 8];
            if (x < half || x > w - half || y < 10 || y > h - 8) return [];
            if (taken.some((b) => b[0] < box[2] && box[0] < b[2] && b[1] < box[3] && box[1] < b[3])) return [];
            taken.push(box);
            const label = el("span", { class: title ? "axis" : "tick" }, text);
            label.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px) translate(-50%, -50%)`;
            return [label];
        });
        this.labels.replaceChildren(...shown);
    }

    private listen(): void {
        const canvas = this.renderer.domElement;
        let down: [number, number] | undefined;
        canvas.addEventListener("pointerdown", (event) => (down = [event.clientX, event.clientY]));
        canvas.addEventListener("pointerup", (event) => {
            if (!down || Math.hypot(event.clientX - down[0], event.clientY - down[1]) > 4) return;
            const box = canvas.getBoundingClientRect();
            const t = nearest(this.pieces, event.clientX - box.left, event.clientY - box.top, this.between, (at) => this.onScreen(at));
            if (t !== undefined) this.onPick(t);
        });
    }
}
