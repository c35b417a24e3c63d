// SPDX-License-Identifier: MIT
// Plans one program, in a thread of its own: whoever does not want to wait ends it. `planner` is emscripten's module.
async function plan(data) {
    const printed = [];
    const told = [];
    const module = await planner({wasmBinary: data.wasm, print: (line) => printed.push(line), printErr: (line) => told.push(line)});
    // Progress is a line that is drawn again; emscripten waits for its end.
    let line = [];
    const decoder = new TextDecoder();
    module.FS.streams[2].tty.ops.put_char = (_, byte) => {
        if (byte !== 10 && byte !== 13) {
            line.push(byte);
            return;
        }
        const text = decoder.decode(new Uint8Array(line)).replace(/\x1b\[K/g, "").trim();
        line = [];
        if (text !== "" && byte === 13) {
            postMessage({progress: text});
        } else if (text !== "") {
            told.push(text);
        }
    };
    const report = "/tmp/report.html"; // not beside the program, whose name is anything
    const words = [data.name, "", report, ...data.options];
    module.FS.writeFile(data.name, data.program);
    if (data.machine !== "") {
        words[1] = "machine";
        module.FS.writeFile(words[1], data.machine);
    }
    const status = module.callMain(words);
    postMessage({status, summary: printed.join("\n"), told, report: module.FS.analyzePath(report).exists ? module.FS.readFile(report) : null});
}

// Also where the memory does not suffice, somebody waits for an answer.
onmessage = ({data}) => plan(data).catch((error) => postMessage({status: 1, told: [`splinefeed: ${error.message ?? error}`], summary: "", report: null}));
