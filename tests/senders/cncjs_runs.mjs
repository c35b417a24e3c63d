#!/usr/bin/env node
// SPDX-License-Identifier: MIT
// CNCjs operates a served machine through a pseudo terminal, and the reference firmware in QEMU: cncjs_runs.mjs FOLDER TOOL IMAGE. FOLDER has CNCjs in
// node_modules. Each step says what must be answered, in which state the machine must be, and where it must stand.
import {execFileSync, spawn} from 'node:child_process';
import {once} from 'node:events';
import {mkdtempSync, rmSync, writeFileSync} from 'node:fs';
import {createRequire} from 'node:module';
import {createServer} from 'node:net';
import {tmpdir} from 'node:os';
import {dirname, join, resolve} from 'node:path';
import {setTimeout as sleep} from 'node:timers/promises';
import {fileURLToPath} from 'node:url';

const packages = resolve(process.argv[2]);
const [, , , tool, image] = process.argv;
const here = dirname(fileURLToPath(import.meta.url));
const machine = join(here, '../serve/machine.toml');
const load = createRequire(join(packages, 'package.json'));
const scratch = mkdtempSync(join(tmpdir(), 'splinefeed-cncjs-'));

function require_that(holds, what) {
    if (!holds) throw new Error(what);
}

// CNCjs, and what a browser does with it.
class Cncjs {
    read = []; // what the machine said, but for statuses
    reports = []; // statuses that this test has asked for
    state = {};
    met = new Set(); // states since the last command
    sender = {};

    // @param bed  the machine: `feed` of moves that are to last [mm/min], `step_mm`, `seconds` that a state may take to come
    constructor(bed) { this.bed = bed; }

    async start(terminal) {
        const door = createServer().listen(0, '127.0.0.1');
        await once(door, 'listening');
        const port = door.address().port;
        door.close();
        const settings = join(scratch, 'cncrc.json');
        writeFileSync(settings, JSON.stringify({secret: 'of this test', ports: [{path: terminal, manufacturer: ''}], state: {checkForUpdates: false}}));
        this.process = spawn(process.execPath, [load.resolve('cncjs/bin/cncjs'), '-H', '127.0.0.1', '-p', String(port), '-c', settings, '--controller', 'Grbl'],
            {env: {...process.env, HOME: scratch}, stdio: 'ignore'});
        const token = load('jsonwebtoken').sign({id: '', name: 'test'}, 'of this test');
        this.socket = load('socket.io-client').connect(`http://127.0.0.1:${port}`, {query: `token=${token}`, reconnectionDelay: 200, reconnectionDelayMax: 200});
        this.terminal = terminal;
        const connected = new Promise(done => this.socket.once('connect', done));
        this.socket.on('controller:state', (type, state) => {
            this.state = state;
            this.met.add(this.word());
        });
        this.socket.on('controller:settings', (type, settings) => { this.settings = settings.settings; });
        this.socket.on('sender:status', sender => { this.sender = sender; });
        this.socket.on('serialport:read', line => { (line.startsWith('<') ? this.reports : this.read).push(line.trim()); });
        await Promise.race([connected, sleep(120000).then(() => { throw new Error('CNCjs does not start'); })]);
    }

    open() {
        this.state = {};
        this.met.clear();
        this.socket.emit('open', this.terminal, {baudrate: 115200, controllerType: 'Grbl'});
    }

    command(...words) {
        this.met.clear();
        this.socket.emit('command', this.terminal, ...words);
    }
    word() { return this.state.status?.activeState; }
    place() { return ['x', 'y', 'z'].map(axis => Number(this.state.status.mpos[axis])); }

    async until(holds, what, seconds = this.bed.seconds) {
        for (const end = Date.now() + 1000 * seconds; !holds(); await sleep(10)) {
            require_that(Date.now() < end, `${what}: not within ${seconds} s, ${JSON.stringify(this.state.status)}, ${JSON.stringify(this.sender)}`);
        }
    }
    // Or it was, since the last command: a state on the way may be short.
    in_state(word, seconds) { return this.until(() => this.word() === word || (word !== 'Idle' && this.met.has(word)), `never ${word}`, seconds); }
    said(pattern) { return this.until(() => this.read.some(line => pattern.test(line)), `never said ${pattern} in ${JSON.stringify(this.read.slice(-20))}`); }

    // The next status.
    async report() {
        const seen = this.reports.length;
        this.command('statusreport');
        await this.until(() => this.reports.length > seen, 'no status');
        return this.reports.at(-1);
    }
    // It says so, and is in the same place later.
    async standing() {
        const places = [];
        for (const end = Date.now() + 1000 * this.bed.seconds; places.length < 2; await sleep(600)) {
            const [, rests, place] = (await this.report()).match(/^<(Idle|Alarm|Hold:0)?.*MPos:([^|>]*)/);
            if (rests) places.push(place);
            require_that(rests || Date.now() < end, `it does not come to rest: ${this.reports.at(-1)}`);
        }
        require_that(places[0] === places[1], `it moves from ${places[0]} to ${places[1]}`);
        return places[0].split(',').map(Number);
    }
    near(at, place) { return place.every((mm, k) => Math.abs(at[k] - mm) <= this.bed.step_mm); }
    async stands_at(...place) {
        const at = await this.standing();
        require_that(this.near(at, place), `it stands at ${at}, not at ${place}`);
    }
    beyond(x) { return this.until(() => this.place()[0] > x, `it does not move beyond ${x}`); }

    // Sends a program and presses start.
    async begin(name, text) {
        this.read = [];
        this.sender = {};
        this.command('gcode:load', name, text);
        await this.until(() => this.sender.name === name && this.sender.total > 0, `${name} is not loaded`);
        this.command('gcode:start');
    }
    async sent(seconds) {
        await this.until(() => this.sender.finishTime > 0, 'the program is not sent', seconds);
        await this.in_state('Idle');
        require_that(this.read.every(line => !/^(error|ALARM|\[MSG:Error)/.test(line)), `it refused: ${this.read}`);
        this.command('gcode:stop', {force: false});
    }
    async go(...place) {
        this.command('gcode', `G90 G0 X${place[0]} Y${place[1]}`);
        await this.until(() => this.word() === 'Idle' && this.near(this.place(), place), `never at ${place}`);
    }
}

function circle(count, per = 400, feed = 6000) {
    const lines = [];
    for (let n = 0; n < count; ++n) {
        lines.push(`G1 X${(150 + 20 * Math.cos(n / per)).toFixed(3)} Y${(100 + 20 * Math.sin(n / per)).toFixed(3)} F${feed}`);
    }
    const last = lines.at(-1).match(/X(\S+) Y(\S+)/);
    return {text: `G21 G90\n${lines.join('\n')}\n`, end: [Number(last[1]), Number(last[2]), 0], count};
}

const steps = {
    async 'connect, read settings'(cncjs) {
        cncjs.socket.emit('list');
        const [ports] = await once(cncjs.socket, 'serialport:list');
        require_that(ports.some(port => port.port === cncjs.terminal), `the port is not to be chosen: ${JSON.stringify(ports)}`);
        cncjs.open();
        await cncjs.in_state('Idle');
        await cncjs.until(() => cncjs.settings?.$132, 'it reads no settings');
        const {$100, $110, $120, $130, $132} = cncjs.settings;
        require_that(String([$100, $110, $120, $130, $132]) === `${cncjs.bed.steps},6000.000,1000.000,300.000,80.000`, `settings: ${JSON.stringify(cncjs.settings)}`);
        await cncjs.until(() => cncjs.state.parserstate?.modal?.wcs === 'G54', 'it reads no modes');
        await cncjs.stands_at(0, 0, 0);
    },
    async 'home'(cncjs) {
        await cncjs.go(12, 7, 0);
        cncjs.command('homing');
        await cncjs.in_state('Home');
        await cncjs.in_state('Idle');
        await cncjs.stands_at(0, 0, 0);
    },
    async 'jog, and cancel it'(cncjs) {
        cncjs.command('gcode', `$J=G21G91X20.5Y-0F${cncjs.bed.feed}`);
        await cncjs.in_state('Jog');
        await cncjs.in_state('Idle');
        await cncjs.stands_at(20.5, 0, 0);
        cncjs.command('gcode', `$J=G21G91X200F${cncjs.bed.feed / 2}`);
        await cncjs.beyond(30);
        cncjs.command('jogCancel');
        await cncjs.in_state('Idle');
        const [x] = await cncjs.standing();
        require_that(x > 30 && x < 200, `the jog was cancelled at ${x}`);
        cncjs.command('gcode', '$J=G90X900F6000'); // beyond the travel
        await cncjs.in_state('Jog');
        await cncjs.in_state('Idle');
        await cncjs.stands_at(300, 0, 0);
    },
    async 'stream 300 lines; hold, resume, override'(cncjs) {
        const {text, end} = cncjs.bed.short;
        await cncjs.go(170, 100, 0);
        await cncjs.begin('short.nc', text);
        await cncjs.in_state('Run');
        cncjs.command('feedhold');
        await cncjs.in_state('Hold');
        const [x] = await cncjs.standing();
        require_that(x > 150 && x < 300, `held at ${x}`);
        cncjs.command('cyclestart');
        await cncjs.in_state('Run');
        cncjs.command('feedOverride', -10);
        cncjs.command('feedOverride', -10);
        await cncjs.until(() => String(cncjs.state.status.ov) === '80,100,100', 'no override');
        await cncjs.sent(3 * cncjs.bed.seconds);
        await cncjs.stands_at(...end);
        cncjs.command('feedOverride', 0);
        await cncjs.until(() => String(cncjs.state.status.ov) === '100,100,100', 'no end of the override');
    },
    async 'stream 20,000 lines'(cncjs) {
        const {text, end} = circle(20000);
        writeFileSync(join(scratch, 'long.nc'), text);
        const said = execFileSync(tool, ['run', join(scratch, 'long.nc'), '--dialect', 'grbl', '-m', machine, '--summary', 'json', '--no-advice'], {stdio: ['ignore', 'pipe', 'ignore']});
        await cncjs.go(170, 100, 0);
        await cncjs.begin('long.nc', text);
        const begun = Date.now();
        await cncjs.in_state('Run');
        await cncjs.sent(120);
        const took = (Date.now() - begun) / 1000;
        const least = JSON.parse(said).cycle_time_s;
        console.log(`  streamed: ${took.toFixed(1)} s; run: ${least.toFixed(1)} s`);
        require_that(took < 2 * least + 4, `20,000 lines take ${took} s instead of ${least} s`);
        await cncjs.stands_at(...end);
    },
    async 'an error in the middle'(cncjs) {
        const {text, end, count} = cncjs.bed.wrong;
        for (const way of ['stop', 'resume']) {
            await cncjs.go(170, 100, 0);
            await sleep(1200); // then lines are counted anew
            await cncjs.begin('wrong.nc', `${text}G999\n${text}`);
            await cncjs.in_state('Run');
            await cncjs.in_state('Hold');
            await cncjs.until(() => /^error:20 /.test(cncjs.sender.holdReason?.msg), 'it is not paused by the error');
            await cncjs.said(new RegExp(`^\\[MSG:Error: ${count + 2}:1 `));
            const [x, y] = await cncjs.standing();
            require_that(Math.abs(Math.hypot(x - 150, y - 100) - 20) < 0.01 + cncjs.bed.step_mm && x !== 170 && x !== end[0], `held at ${x}, ${y}`);
            cncjs.command(way === 'stop' ? 'gcode:stop' : 'gcode:resume', {force: true});
            await cncjs.in_state('Idle');
            await (way === 'stop' ? cncjs.stands_at(x, y, 0) : cncjs.stands_at(...end)); // what was right before the error, and no more
            cncjs.command('gcode:stop', {force: true});
            await cncjs.in_state('Idle');
        }
    },
    async 'probe, and find nothing'(cncjs) {
        await cncjs.go(10, 100, 0);
        cncjs.read = [];
        cncjs.command('gcode', 'G38.2 Z-5 F600');
        await cncjs.in_state('Alarm');
        await cncjs.said(/^ALARM:5/);
        await cncjs.said(/^\[PRB:10\.000,100\.000,-5\.000:0\]/);
        await cncjs.stands_at(10, 100, -5);
        cncjs.command('unlock');
        await cncjs.in_state('Idle');
    },
    async 'reset while it runs'(cncjs) {
        await cncjs.go(10, 100);
        const from = await cncjs.standing();
        cncjs.command('gcode', `G90 G1 X200 F${cncjs.bed.feed}`);
        await cncjs.beyond(20);
        cncjs.command('reset');
        await cncjs.in_state('Idle');
        const [x, ...others] = await cncjs.standing();
        require_that(x > 20 && x < 190 && String(others) === String(from.slice(1)), `at ${x}, ${others}`);
    },
    async 'disconnect in the middle, and come back'(cncjs) {
        await cncjs.go(10, 100, -5);
        cncjs.command('gcode', 'G90 G1 X100 F3000');
        await cncjs.in_state('Run');
        await sleep(300);
        cncjs.read = [];
        cncjs.socket.emit('close', cncjs.terminal);
        await sleep(1000);
        cncjs.open();
        await cncjs.in_state('Hold');
        await cncjs.said(/^\[MSG:Held: /);
        const [x] = await cncjs.standing();
        require_that(x > 11 && x < 99, `held at ${x}`);
        cncjs.command('cyclestart');
        await cncjs.in_state('Idle');
        await cncjs.stands_at(100, 100, -5);
    },
    async 'killed in the middle, and started again'(cncjs) {
        cncjs.command('gcode', 'G90 G1 X280 F1200');
        await cncjs.in_state('Run');
        await sleep(1000);
        cncjs.process.kill('SIGKILL');
        await once(cncjs.process, 'exit');
        cncjs.socket.close();
        await cncjs.start(cncjs.terminal);
        cncjs.open();
        await cncjs.in_state('Hold');
        const place = await cncjs.standing();
        cncjs.command('reset');
        await cncjs.in_state('Idle');
        await cncjs.stands_at(...place);
        await cncjs.go(0, 0, -5);
    },
};

// What only the firmware's line is like: nobody tells it that its sender has gone, so it goes on.
const on_board = {
    'home, which it has not': async cncjs => {
        await cncjs.go(12.5, 7.5);
        cncjs.read = [];
        cncjs.command('homing');
        await cncjs.said(/^\[MSG:No home of X, Y, Z: /);
        await cncjs.said(/^error:5\b/);
        await cncjs.stands_at(12.5, 7.5, 0);
        await cncjs.go(0, 0);
    },
    'disconnect in the middle, and come back': async cncjs => {
        await cncjs.go(10, 100);
        cncjs.command('gcode', `G90 G1 X100 F${cncjs.bed.feed / 2}`);
        await cncjs.beyond(12);
        cncjs.socket.emit('close', cncjs.terminal);
        await sleep(1000);
        cncjs.open();
        await cncjs.in_state('Run');
        await cncjs.in_state('Idle');
        await cncjs.stands_at(100, 100, 0);
        await cncjs.go(0, 0);
    },
};

// Runs those steps on a machine that another process is, and ends it as `end` says.
async function operate(bed, begin, names, end) {
    const process_of = begin();
    const cncjs = new Cncjs(bed);
    let told = '';
    let answered = '';
    try {
        process_of.stderr?.on('data', text => { told += text; });
        process_of.stdout.on('data', text => { answered += text; });
        const [said] = await Promise.race([once(process_of.stdout, 'data'), once(process_of, 'exit')]);
        if (said === 77) {
            console.log(`without the firmware: ${answered}`);
            return;
        }
        await cncjs.start(bed.terminal);
        for (const name of names) {
            try {
                await (bed.own?.[name] ?? steps[name])(cncjs);
                console.log(`${name}, ${bed.name}: passed`);
            } catch (failure) {
                throw new Error(`${name}, ${bed.name}: ${failure.message}`);
            }
        }
        answered = '';
        end(process_of);
        const [code] = await once(process_of, 'close');
        require_that(code === 0 && told === '' && answered === bed.ends, `${bed.name} ends with ${code}: ${told}${answered}`);
    } catch (failure) {
        throw new Error(`${failure.message} ${told}`);
    } finally {
        if (process_of.stdin) process_of.stdin.end(); // it ends its emulator
        else process_of.kill('SIGKILL');
        cncjs.process?.kill('SIGKILL');
        cncjs.socket?.close();
    }
}

const served = {name: 'served', terminal: join(scratch, 'machine'), steps: '320.000', step_mm: 0, feed: 6000, seconds: 20,
    short: circle(300), wrong: circle(12000), ends: ''}; // of the 12,000 lines 8000 are read before it begins to move
// Its time is not the host's. What is to be met on its way lasts for tens of seconds, so that a busy host meets it.
const board = {name: 'firmware', terminal: join(scratch, 'board'), steps: '80.000', step_mm: 0.0126, feed: 600, seconds: 600,
    short: circle(300, 40, 600), wrong: circle(800, 40, 3000), own: on_board, ends: '0 0 0\n'};
let status = 1;
try {
    await operate(board, () => spawn('python3', ['-B', join(here, '../firmware/board_at_terminal.py'), image, 'lm3s6965evb', board.terminal], {stdio: ['pipe', 'pipe', 'inherit']}), [
        'connect, read settings', 'home, which it has not', 'jog, and cancel it', 'stream 300 lines; hold, resume, override', 'an error in the middle',
        'reset while it runs', 'disconnect in the middle, and come back'], python => python.stdin.end());
    await operate(served, () => spawn(tool, ['serve', '-m', machine, '--pty', served.terminal], {stdio: ['ignore', 'pipe', 'pipe']}), Object.keys(steps),
        server => server.kill('SIGINT'));
    status = 0;
} catch (failure) {
    console.log(failure.message);
} finally {
    rmSync(scratch, {recursive: true, force: true});
}
process.exit(status);
