#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# What the Debian package has for systemd: the unit is one that systemd takes, what it starts serves, and udev takes the rules:
# serve_unit.sh TOOL.
source "$(dirname "${BASH_SOURCE[0]}")/../tools/common.sh"

need systemd-analyze
tool=$(realpath "$1")
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
unit=$scratch/splinefeed-serve@.service
sed "s|/usr/bin/splinefeed|$tool|" cmake/packaging/systemd/splinefeed-serve@.service >"$unit"
said=$(systemd-analyze verify --man=no "$unit" "$scratch/splinefeed-serve@router.service" 2>&1) || { echo "$said"; exit 1; }
if [[ $said ]]; then # it exits with 0 for keys that it does not know
    echo "$said"
    exit 1
fi

# As systemd would fill it in, for a machine of that name.
mkdir -p "$scratch/etc" "$scratch/state/splinefeed/router"
cp tests/serve/machine.toml "$scratch/etc/router.toml"
SERVE=$(sed -n 's/^Environment="SERVE=\(.*\)"$/\1/p' "$unit" | sed 's/:2300/:0/')
command=$(sed -n 's/^ExecStart=//p' "$unit" | sed "s|%i|router|g; s|%S|$scratch/state|g; s|/etc/splinefeed/|$scratch/etc/|; s|\\\$SERVE|$SERVE|")

# shellcheck disable=SC2086 # words
timeout --preserve-status --signal TERM 2 $command >"$scratch/said" 2>&1 </dev/null && status=0 || status=$?
if ((status != 0)) || ! grep -q '^serving tcp 127.0.0.1:' "$scratch/said"; then
    echo "exit status $status: $command"
    cat "$scratch/said"
    exit 1
fi

if udevadm verify --help >/dev/null 2>&1; then
    udevadm verify cmake/packaging/systemd/60-splinefeed.rules
else
    echo "this udevadm cannot verify rules"
fi
