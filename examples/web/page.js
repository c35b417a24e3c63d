// SPDX-License-Identifier: MIT
// The page: a program and a machine in, a report out. Nothing leaves the browser.
const byId = (id) => document.getElementById(id);

/** @returns bytes of what pack.mjs has put into the page: their number, and five letters for four of them */
async function unpacked(id) {
    const [length, text] = byId(id).textContent.split(" ");
    const bytes = new DataView(new ArrayBuffer(Math.ceil(length / 4) * 4));
    for (let i = 0; i * 5 < text.length; ++i) {
        let word = 0;
        for (let k = 0; k < 5; ++k) {
            const code = text.charCodeAt(i * 5 + k);
            word = word * 85 + code - (code > 92 ? 42 : code > 60 ? 41 : 40);
        }
        bytes.setUint32(i * 4, word);
    }
    const packed = new Uint8Array(bytes.buffer, 0, Number(length));
    const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
    return new Uint8Array(await new Response(stream).arrayBuffer());
}

const parts = Promise.all([unpacked("planner"), unpacked("worker")]).then(([wasm, code]) => ({
    wasm,
    worker: URL.createObjectURL(new Blob([code], {type: "text/javascript"})),
}));

let program = null; // {name, bytes}
let running = null;
let shown = null;

function say(text, isError = false) {
    byId("said").textContent = text;
    byId("said").className = isError ? "error" : "";
}

function options() {
    const out = [];
    for (const name of ["dialect", "ignore", "tolerance", "zero"]) {
        const value = byId(name).value.trim();
        if (value !== "" && value !== "auto") {
            out.push(`${name}=${value}`);
        }
    }
    if (byId("machine").value.trim() === "") {
        for (const key of ["max_velocity_mm_s", "max_acceleration_mm_s2", "max_jerk_mm_s3"]) {
            const value = byId(key).value.trim();
            for (const axis of value === "" ? [] : ["x", "y", "z"]) {
                out.push(`set=axis.${axis}.${key}=${value}`);
            }
        }
    }
    return out;
}

function stop() {
    running?.terminate();
    running = null;
    document.body.classList.remove("busy");
}

function show({status, told, summary, report}) {
    stop();
    const figures = summary === "" ? null : JSON.parse(summary);
    const time = figures === null ? "" : `${figures.cycle_time_s.toFixed(1)} s of motion. `;
    say(time + told.join("\n"), status !== 0);
    byId("result").hidden = report === null;
    if (report !== null) {
        URL.revokeObjectURL(shown);
        shown = URL.createObjectURL(new Blob([report], {type: "text/html"}));
        byId("report").src = shown;
        byId("save").href = shown;
        byId("save").download = `${program.name}.html`;
    }
    document.body.dataset.status = status; // for tests
}

async function plan() {
    stop();
    if (program === null) {
        say("Choose a program, or drop one on this page.", true);
        return;
    }
    delete document.body.dataset.status;
    document.body.classList.add("busy");
    say("Planning …");
    const {wasm, worker} = await parts;
    running = new Worker(worker);
    running.onmessage = ({data}) => (data.progress === undefined ? show(data) : say(data.progress));
    running.onerror = (event) => show({status: 1, told: [event.message], summary: "", report: null});
    running.postMessage({wasm, name: program.name, program: program.bytes, machine: byId("machine").value.trim(), options: options()});
}

async function take(file) {
    program = {name: file.name, bytes: new Uint8Array(await file.arrayBuffer())};
    byId("name").textContent = file.name;
    plan();
}

byId("file").addEventListener("change", (event) => event.target.files.length > 0 && take(event.target.files[0]));
byId("example").addEventListener("click", () => take(new File([byId("program").textContent], "bracket.ngc")));
byId("plan").addEventListener("click", plan);
byId("cancel").addEventListener("click", () => {
    stop();
    say("Cancelled.");
});
addEventListener("dragover", (event) => event.preventDefault());
addEventListener("drop", (event) => {
    event.preventDefault();
    if (event.dataTransfer.files.length > 0) {
        take(event.dataTransfer.files[0]);
    }
});
