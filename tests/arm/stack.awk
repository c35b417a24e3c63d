# SPDX-License-Identifier: MIT
# The deepest stack of the program, from the compiler's call graph (-fcallgraph-info=su,da): awk -v scalar=Fixed -v jerk=1
# [-v root=FUNCTION] [-v operated=1 [-v points=1] [-v values=1] [-v extends=1]] -f stack.awk FILE.ci... jerk is 1 where it is limited, none where nothing is planned; operated: by
# senders. Fails on recursion, on frames of variable size, and on calls that lead to unknown places.

BEGIN {
    # libgcc, measured in its disassembly (the largest, Cortex-M0) and rounded up; each with all that it calls.
    library["__aeabi_ldivmod"] = 104
    library["__aeabi_uldivmod"] = 80
    library["__aeabi_uidivmod"] = library["__aeabi_idivmod"] = library["__aeabi_uidiv"] = library["__aeabi_idiv"] = 16
    library["__aeabi_lmul"] = 32
    library["__clzdi2"] = library["__clzsi2"] = 16
    library["__aeabi_llsl"] = library["__aeabi_llsr"] = library["__aeabi_lasr"] = 0
    split("f2lz f2ulz l2f ul2f d2lz d2ulz l2d ul2d", soft, " ")
    for (i in soft) { library["__aeabi_" soft[i]] = 104 }
    split("dadd dsub drsub dmul ddiv dcmpeq dcmplt dcmple dcmpge dcmpgt dcmpun cdcmpeq cdcmple d2uiz", soft, " ")
    for (i in soft) { library["__aeabi_" soft[i]] = 72 }
    split("d2f f2d d2iz i2d ui2d fadd fsub frsub fmul fdiv fcmpeq fcmplt fcmple fcmpge fcmpgt fcmpun cfcmpeq i2f ui2f f2iz f2uiz", soft, " ")
    for (i in soft) { library["__aeabi_" soft[i]] = 36 }
    if (root == "") { root = "_ZN12_GLOBAL__N_18on_resetEv" }
    # Virtual calls: the arc length asks the curve, which is a G2Spline here, the stream its samples, and those their
    # plan: a FeedPlan, or where the jerk is limited a JerkPlan. What makes the trajectory asks its planner.
    # A call asks for those of the method that it names.
    of = "I" (scalar == "float" ? "f" : "NS_5FixedE") "E"
    in_float = "INS_5FixedEfE"
    served = "(4cell|5clear|5steer|7advance|7prepare|7rest_at|8standing)E"
    plan = "^_ZNK?10splinefeed8" (jerk ? "JerkPlan" in_float : "FeedPlan" of) served
    twice = "I" (scalar == "float" ? "ff" : "NS_5FixedES[0-9A-Z]*_") "E" # it samples in the scalar, too
    sampler = "^_ZNK?10splinefeed14ProfileSampler" twice "(4next|5clear|7at_rest)E"
    planner = "^_ZNK?10splinefeed" (jerk ? "11JerkPlanner" in_float : "19AccelerationPlanner" of) "(4fits|5build)E"
    curve = scalar == "float" ? "_ZN10splinefeed18ControlPointStreamIfNS_11PlainJointsIfEEE4nextERNS_12CurveSegmentIfEE" \
                              : "_ZN10splinefeed18ControlPointStreamINS_5FixedENS_11PlainJointsIS1_EEE4nextERNS_12CurveSegmentIS1_EE"
    # The controller calls the motion, the machine, and the functions of its commands; the list of settings those of its rows. The path
    # within a tolerance is guarded. There is no table of tools. points: the interpreter has memory for curves through points.
    # values: expressions are evaluated, with parameters by number. extends: there is a WordExtension, for which no bound is known yet.
    extension = "^(take|adapt|apply|take_back|end_program|system|turn|turn_arc)$"
    if (extends) { fail("the image has a WordExtension") }
    if (operated) {
        program = "INS_5FixedEE" # what programs are interpreted in
        guard = "^_ZNK?10splinefeed11TravelGuard" of "(5begin|9has_ended)E"
        curve = "_ZN10splinefeed11TravelGuard" of "4nextERNS_12CurveSegment" (scalar == "float" ? "IfEE" : "IS1_EE")
        split("Controller|DollarCommands|SpindleOrders;ScalarStream" of "|14StepperMachine|DollarCommands;10LineMotion|10MoveStream;ScalarStream" of ";SettingList;6detail[0-9]+(show_|axis_row.*_FUN);" \
              "TravelGuard;13TolerancePath" of "4next;10Expression|6Parser;18NumberedParameters;" \
              "BlockConditions|BlockInterpreter|BlockReader;" (values ? "10Expression" : "^$") ";" \
              "11Interpreter" program ";" (points ? "12SplinePoints" program : "^$"), may_call, ";")
    }
}

function quoted(line, key) {
    line = substr(line, index(line, key ": \"") + length(key) + 3)
    line = substr(line, 1, index(line, "\"") - 1)
    sub(/^.*:/, "", line)     # local functions: FILE:NAME
    sub(/C1E/, "C2E", line)   # a complete object's constructor is its base object's here
    return line
}

/^node: / && match($0, /[0-9]+ bytes \([a-z,]*\)/) {
    name = quoted($0, "title")
    frame[name] = substr($0, RSTART) + 0
    variable[name] = $0 !~ /bytes \(static\)/ && $0 !~ /bytes \(dynamic,bounded\)/
}
/^edge: / {
    from = quoted($0, "sourcename")
    to = quoted($0, "targetname")
    if (to == "__indirect_call" && from ~ /ArcLength|CheckedSource/) { to = curve }
    if (to == "__indirect_call" && from ~ /BlockInterpreter|BlockReader|WorkFrame/ && method_at(place_of($0)) ~ extension) { next }
    if (to == "__indirect_call" && (pair = pair_of(from))) {
        any_of[from] = may_call[pair + 1]
        next
    }
    if (to == "__indirect_call" && from ~ /make|Sampler|SegmentStream|Trajectory|ScalarStream/) {
        asks[from] = asks[from] method_at(place_of($0)) " "
    } else if (!((from, to) in known)) {
        known[from, to] = 1
        calls[from] = calls[from] to "\n"
    }
}

# Which pair of may_call a function belongs to; 0: to none.
function pair_of(from, i) {
    if (from ~ "ScalarStream" of) { return 0 }
    for (i = 1; i in may_call; i += 2) {
        if (from ~ may_call[i]) { return i }
    }
    return 0
}

function place_of(line) {
    return substr(line, match(line, /label: "/) + 8, length(line))
}

# The method that is called in FILE:LINE:COLUMN, which is behind its name.
function method_at(place, parts, text, i) {
    split(place, parts, ":")
    for (i = 0; i < parts[2] && (getline text < parts[1]) > 0; ++i) { }
    close(parts[1])
    text = substr(text, 1, parts[3] - 1)
    if (i < parts[2] || !match(text, /[a-z_]+$/)) { fail("no method is called at " place) }
    return substr(text, RSTART)
}

function fail(reason) {
    print "stack: " reason
    failed = 1
    exit 1
}

# `from` calls the methods that it asks for, of all whose names match.
function link(from, names, methods, count, i, name, found) {
    count = split(asks[from], methods, " ")
    for (i = 1; i <= count; ++i) {
        found = 0
        for (name in frame) {
            if (name ~ names && index(name, length(methods[i]) methods[i] "E")) {
                calls[from] = calls[from] name "\n"
                found = 1
            }
        }
        if (!found && from ~ of) { fail("no " methods[i] " is known that " from " could call") }
    }
}

# The deepest stack of a function and all it calls; `way` is how the deepest call goes on.
function depth(name, targets, count, i, d, deepest) {
    if (name in total) { return total[name] }
    if (name in library) { return library[name] }
    if (!(name in frame)) { fail("no bound for a call of " name) }
    if (variable[name]) { fail("frame of variable size in " name) }
    if (active[name]) { fail("recursion through " name) }
    active[name] = 1
    deepest = 0
    count = split(calls[name], targets, "\n")
    for (i = 1; i < count; ++i) {
        d = depth(targets[i])
        if (d > deepest) {
            deepest = d
            way[name] = targets[i]
        }
    }
    active[name] = 0
    return total[name] = frame[name] + deepest
}

END {
    if (failed) { exit 1 }
    for (from in any_of) {
        found = 0
        for (name in frame) {
            if (name != from && name ~ any_of[from] && !(name ~ /DollarCommands/ && from !~ /execute_line/)) {
                calls[from] = calls[from] name "\n"
                found = 1
            }
        }
        if (!found && any_of[from] != "^$") { fail("nothing is known that " from " could call") }
    }
    for (from in asks) {
        if (from ~ /ScalarStream/) {
            link(from, planner "|" plan "|" sampler "|" guard)
        } else if (from ~ /make/) {
            link(from, planner)
        } else if (from ~ /SegmentStream/) {
            link(from, sampler)
        } else {
            link(from, from ~ /Sampler/ ? plan : plan "|" sampler)
        }
    }
    plans = samplers = planners = 0
    for (name in frame) {
        plans += name ~ plan
        samplers += name ~ sampler
        planners += name ~ planner
    }
    # Eight functions of a plan, three of a sampler, two of a planner: those that were renamed would be left out.
    if (jerk != "none" && (plans < 5 || samplers < 2 || planners < 2)) {
        fail(plans " functions of plans, " samplers " of samplers and " planners " of planners have the names that are known here")
    }
    print "stack bound " depth(root) " bytes:"
    for (name = root; name != ""; name = way[name]) {
        printf "  %5d %s\n", (name in frame) ? frame[name] : library[name], name
    }
}
