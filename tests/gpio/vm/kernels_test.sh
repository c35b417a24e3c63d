#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Which kernels the bed may take, of what an index has: a kernel without its headers or its source is none, and kbuild may be a later one.
source "$(dirname "${BASH_SOURCE[0]}")/../../tools/common.sh"
source tests/gpio/vm/apt.sh

index='linux-image-6.1.0-57-amd64 | 6.1.192-3 | mirror
linux-headers-6.1.0-57-amd64 | 6.1.192-3 | mirror
linux-image-6.1.0-9-amd64 | 6.1.90-1 | mirror
linux-headers-6.1.0-9-amd64 | 6.1.90-1 | mirror
linux-headers-6.1.0-9-common | 6.1.90-1 | mirror
linux-image-6.1.0-56-amd64 | 6.1.192-2 | mirror
linux-image-6.1.0-56-amd64 | 6.1.192-2 | another mirror
linux-headers-6.1.0-56-amd64 | 6.1.192-2 | mirror
linux-headers-6.1.0-56-common | 6.1.192-2 | mirror
linux-image-6.1.0-55-amd64 | 6.1.192-1 | mirror
linux-headers-6.1.0-55-amd64 | 6.1.192-1 | mirror
linux-headers-6.1.0-55-common | 6.1.192-1 | mirror
linux-image-6.1.0-58-amd64 | 6.1.200-1 | mirror
linux-headers-6.1.0-58-amd64 | 6.1.200-1 | mirror
linux-headers-6.1.0-58-common | 6.1.200-1 | mirror
linux-source-6.1 | 6.1.200-1 | mirror
linux-source-6.1 | 6.1.192-3 | mirror
linux-source-6.1 | 6.1.192-2 | mirror
linux-source-6.1 | 6.1.90-1 | mirror
linux-kbuild-6.1 | 6.1.192-3 | mirror
linux-kbuild-6.1 | 6.1.90-1 | mirror'
# 58 has no kbuild as late as itself, 57 no common headers, 55 no source.
meant='6.1.0-56-amd64 6.1.192-2 linux-kbuild-6.1=6.1.192-3
6.1.0-9-amd64 6.1.90-1 linux-kbuild-6.1=6.1.90-1'
diff <(echo "$meant") <(complete_kernels <<<"$index")
if [[ $(complete_kernels </dev/null) ]]; then
    echo "there is a kernel in an empty index"
    exit 1
fi
echo "the choice is right"
