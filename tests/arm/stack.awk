# SPDX-License-Identifier: MIT
# The deepest stack of the program, from the compiler's call graph (-fcallgraph-info=su,da): awk -v scalar=Fixed -v smooth=1
# [-v root=FUNCTION] [-v planless=1] -f stack.awk FILE.ci... (planless: a program without a planner). Fails on recursion, on frames of variable size, and on calls that lead to unknown places.

BEGIN {
    # libgcc, measured in its disassembly (the largest, Cortex-M0) and rounded up; each with all that it calls.
    library["__aeabi_ldivmod"] = 104
    library["__aeabi_uldivmod"] = 80
    library["__aeabi_uidivmod"] = library["__aeabi_uidiv"] = library["__aeabi_idiv"] = 16
    library["__aeabi_lmul"] = 32
    library["__clzdi2"] = 16
    library["__aeabi_llsl"] = library["__aeabi_llsr"] = library["__aeabi_lasr"] = 0
    if (root == "") { root = "_ZN12_GLOBAL__N_18on_resetEv" }
    # Virtual calls: the arc length asks the curve, which is a G2Spline here, the stream its samples, and those their
    # plan: a FeedPlan, or where motions are averaged a SmoothPlan. What makes the trajectory asks its planner.
    of = "I" (scalar == "float" ? "f" : "NS_5FixedE") "E"
    plan = "^_ZNK?10splinefeed" (smooth ? "10SmoothPlan" : "8FeedPlan") of "(4cell|5clear|5steer|7advance|7prepare|7rest_at|8standing)E"
    sampler = "^_ZNK?10splinefeed" (smooth ? "13SmoothSampler" : "14ProfileSampler") of "(4next|5clear|7at_rest)E"
    planner = "^_ZNK?10splinefeed" (smooth ? "14BoundedPlanner" : "19AccelerationPlanner") of "(4fits|5build)E"
    curve = scalar == "float" ? "_ZN10splinefeed18ControlPointStreamIfNS_11PlainJointsIfEEE4nextERNS_12CurveSegmentIfEE" \
                              : "_ZN10splinefeed18ControlPointStreamINS_5FixedENS_11PlainJointsIS1_EEE4nextERNS_12CurveSegmentIS1_EE"
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
    makes = from ~ /make/
    if (to == "__indirect_call" && makes) {
        asks_planner[from] = 1
    } else if (to == "__indirect_call" && from ~ /SegmentStream|Trajectory/) {
        asks_sampler[from] = 1
    }
    if (to == "__indirect_call" && makes) {
    } else if (to == "__indirect_call" && from ~ /Sampler|Trajectory/) {
        asks_plan[from] = 1
    } else if (to == "__indirect_call" && from ~ /SegmentStream/) {
    } else if (!((from, to) in known)) {
        known[from, to] = 1
        calls[from] = calls[from] to "\n"
    }
}

function fail(reason) {
    print "stack: " reason
    failed = 1
    exit 1
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
    plans = samplers = planners = 0
    for (name in frame) {
        if (name ~ plan) {
            ++plans
            for (from in asks_plan) { calls[from] = calls[from] name "\n" }
        }
        if (name ~ sampler) {
            ++samplers
            for (from in asks_sampler) { calls[from] = calls[from] name "\n" }
        }
        if (name ~ planner) {
            ++planners
            for (from in asks_planner) { calls[from] = calls[from] name "\n" }
        }
    }
    # Seven functions of a plan, three of a sampler, two of a planner: those that were renamed would be left out.
    if (!planless && (plans < 5 || samplers < 2 || planners < 2)) {
        fail(plans " functions of plans, " samplers " of samplers and " planners " of planners have the names that are known here")
    }
    print "stack bound " depth(root) " bytes:"
    for (name = root; name != ""; name = way[name]) {
        printf "  %5d %s\n", (name in frame) ? frame[name] : library[name], name
    }
}
