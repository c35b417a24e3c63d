#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""What bench/linuxcnc_tp.py runs as LinuxCNC's display, in the machine's own name spaces: it homes, runs a program, does what a file of
actions says, records every servo period, and writes the samples and HAL's figures.

  job.json   {"actions": [[SECONDS, WHAT, VALUE], ...], "timeout_s": S, "figures": [names of HAL's pins and parameters]}
  WHAT       hold, resume, step, reverse, forward, override, rapid, limit (mm/s), adaptive, abort, mdi (words)
"""
import array
import json
import os
import subprocess
import threading
import time

import hal
import linuxcnc

job = json.load(open("job.json"))
component = hal.component("bench_driver")
component.ready()
samples = hal.stream(component, hal.sampler_base)
columns = job["columns"]
rows = array.array("d")
recording = threading.Event()
ended = threading.Event()
first_sample, last_sample = [], []


def record():
    while not ended.is_set():
        row = samples.read()
        if row is None:
            time.sleep(0.005)
        elif recording.is_set():
            first_sample[:] = first_sample or [samples.sampleno]
            last_sample[:] = [samples.sampleno]
            rows.extend(float(x) for x in row)


command, errors, status = linuxcnc.command(), linuxcnc.error_channel(), linuxcnc.stat()
said = []


def listen():
    status.poll()
    while (message := errors.poll()) is not None:
        if message[0] in (linuxcnc.OPERATOR_ERROR, linuxcnc.NML_ERROR):
            said.append(message[1].strip())


def wait(condition, seconds):
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        listen()
        if condition():
            return True
        time.sleep(0.01)
    return False


def idle():
    return status.interp_state == linuxcnc.INTERP_IDLE and status.inpos and status.queue == 0 and status.state != linuxcnc.RCS_EXEC


def act(what, value):
    if what == "hold":
        command.auto(linuxcnc.AUTO_PAUSE)
    elif what == "resume":
        command.auto(linuxcnc.AUTO_RESUME)
    elif what == "step":
        command.auto(linuxcnc.AUTO_STEP)
    elif what == "reverse":
        command.auto(linuxcnc.AUTO_REVERSE)
    elif what == "forward":
        command.auto(linuxcnc.AUTO_FORWARD)
    elif what == "override":
        command.feedrate(value)
    elif what == "rapid":
        command.rapidrate(value)
    elif what == "limit":
        command.maxvel(value)
    elif what == "adaptive":
        subprocess.run(["halcmd", "sets", "adaptive", str(value)], check=False)
    elif what == "abort":
        command.abort()
    elif what == "mdi":
        command.wait_complete()
        wait(idle, 20)
        command.mode(linuxcnc.MODE_MDI)
        command.wait_complete()
        command.mdi(value)
        command.wait_complete(20)


def run():
    while True:
        try:
            status.poll()
            break
        except linuxcnc.error:
            time.sleep(0.02)
    for state in (linuxcnc.STATE_ESTOP_RESET, linuxcnc.STATE_ON):
        command.state(state)
        command.wait_complete()
    if not wait(lambda: status.task_state == linuxcnc.STATE_ON, 20):
        return "the machine is not on"
    command.mode(linuxcnc.MODE_MANUAL)
    command.wait_complete()
    command.home(-1)
    if not wait(lambda: all(status.homed[: status.joints]), 20):
        return "no homing"
    command.mode(linuxcnc.MODE_AUTO)
    command.wait_complete()
    command.set_block_delete(False)
    command.set_optional_stop(False)
    command.program_open(os.path.join(os.getcwd(), "program.ngc"))
    command.wait_complete()
    recording.set()
    time.sleep(0.1)
    begin = time.monotonic()
    command.auto(linuxcnc.AUTO_RUN, 0)
    wait(lambda: status.interp_state != linuxcnc.INTERP_IDLE or said, 60) # a loaded computer is late
    actions = sorted(job["actions"], key=lambda a: a[0])
    busy = time.monotonic() # when it last was
    while time.monotonic() - begin < job["timeout_s"]:
        listen()
        while actions and time.monotonic() - begin >= actions[0][0]:
            _, what, value = actions.pop(0)
            act(what, value)
        paused = status.task_mode == linuxcnc.MODE_AUTO and status.interp_state == linuxcnc.INTERP_PAUSED
        if paused and not job["actions"]: # M0, M1
            command.auto(linuxcnc.AUTO_RESUME)
        if not idle() or actions:
            busy = time.monotonic()
        elif time.monotonic() - busy > 2.0: # it also shows an old state for a while
            recording.clear()
            return ""
        time.sleep(0.002)
    return "no end within %g s" % job["timeout_s"]


thread = threading.Thread(target=record, daemon=True)
thread.start()
problem = run()
ended.set()
thread.join()
listen()
figures = {}
for name in job["figures"]:
    try:
        figures[name] = hal.get_value(name)
    except RuntimeError:
        pass
lost = hal.get_value("sampler.0.overruns") or (first_sample and last_sample[0] - first_sample[0] + 1 != len(rows) // columns)
rows.tofile(open("samples.bin", "wb"))
json.dump({"problem": problem or ("samples were lost" if lost else ""), "said": said, "figures": figures,
           "position": list(status.position)}, open("result.json", "w"))
