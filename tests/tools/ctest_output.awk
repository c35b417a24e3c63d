# SPDX-License-Identifier: MIT
# Shortens `ctest --verbose`: of a test that passed one line, of a skipped one the reason, of a failed one all it said. At the end what was not
# tested because something is not here; what --long runs is not missed.
/^ *Start +[0-9]+:/ || /^test [0-9]+$/ { next }
/^[0-9]+: / {
    number = $0
    sub(/:.*/, "", number)
    said[number] = said[number] $0 "\n"
    if ($0 ~ /SKIPPED: /) { reason[number] = reason[number] "        " substr($0, index($0, "SKIPPED: ")) "\n" }
    next
}
/ Test +#[0-9]+: / {
    number = $0
    sub(/^.* Test +#/, "", number)
    sub(/:.*/, "", number)
    print
    if ($0 ~ /\*\*\*Skipped/) {
        printf "%s", reason[number]
        if (reason[number] !~ /: .\/check --long\n/) { missed = missed "    " $4 "\n" reason[number] }
    } else if ($0 ~ /\*\*\*/) { printf "%s", said[number] }
    delete said[number]
    fflush()
    next
}
NF > 0
END { if (missed) { printf "NOT TESTED, because something is not here:\n%s", missed } }
