# SPDX-License-Identifier: MIT
# Debian's packages for unpacking only: nothing is installed, and the host's sources and lists stay as they are. To be sourced.
# shellcheck shell=bash

# own_apt FOLDER [SUITE]: from here on apt_options ask apt with an index of its own in FOLDER, of the host's sources as they
# are; with SUITE of that suite alone, on the mirror that the host uses. Fails where that cannot be had.
apt_options=(-o APT::Sandbox::User=root)
own_apt() {
    local folder=$1 suite=${2-} mirror keyring=/usr/share/keyrings/debian-archive-keyring.gpg signed_by=''
    mkdir -p "$folder/lists/partial" "$folder/cache/archives/partial"
    apt_options+=(-o Dir::State::lists="$folder/lists" -o Dir::Cache="$folder/cache")
    if [[ -n $suite ]]; then
        # shellcheck disable=SC2016 # $(REPO_URI) is for apt to expand
        mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 'Label: Debian' | sort -u | head -n 1)
        if [[ -z $mirror ]]; then mirror=$(mirror_of_sources); fi
        if [[ -z $mirror ]]; then return 1; fi
        if [[ -e $keyring ]]; then signed_by="[signed-by=$keyring]"; fi
        echo "deb $signed_by $mirror $suite main" >"$folder/sources.list"
        apt_options+=(-o Dir::Etc::sourcelist="$folder/sources.list" -o Dir::Etc::sourceparts=/dev/null
            -o APT::Update::Error-Mode=any)
    fi
    apt-get "${apt_options[@]}" --quiet=2 update
}

# The first mirror in the host's sources: what to ask before any index was ever fetched.
mirror_of_sources() {
    local files=(/etc/apt/sources.list.d/debian.sources /etc/apt/sources.list)
    cat "${files[@]}" 2>/dev/null | sed -nE 's/^(URIs:|deb( \[[^]]*\])?) *([a-z+]*:[^ ]*).*/\3/p' | head -n 1 || true
}

# field PACKAGE[=VERSION] FIELD: of the package's record; empty where apt does not know it.
field() {
    apt-cache "${apt_options[@]}" show --no-all-versions "$1" 2>/dev/null | sed -n "s/^$2: //p" | head -n 1
}

# depends PACKAGE[=VERSION] PREFIX: the names of the packages that it depends on and that begin with PREFIX.
depends() {
    { field "$1" Pre-Depends && field "$1" Depends; } | tr ',|' '\n' | sed 's/^ *//; s/[ (].*//' | grep "^$2" | sort -u || true
}

# kernels: of each kernel whose image, headers and source apt knows in one version, the release, that version, and linux-kbuild=VERSION,
# which is of the same version or, as the headers allow, of a later one. Newest first.
kernels() {
    local names
    mapfile -t names < <(apt-cache "${apt_options[@]}" pkgnames linux- | grep -E '^linux-((image|headers)-[0-9.]+-[0-9]+-(amd64|common)|(kbuild|source)-[0-9.]+)$')
    if ((${#names[@]} == 0)); then return 0; fi
    apt-cache "${apt_options[@]}" madison "${names[@]}" | complete_kernels
}

# complete_kernels: these lines from those of `apt-cache madison`.
complete_kernels() {
    tr -d ' ' | sort --field-separator='|' --key=2,2V | awk -F '|' '
        { has[$1, $2] = 1 }
        $1 ~ /^linux-kbuild-/ { newest[$1] = $2; rank[$1] = NR }
        $1 ~ /^linux-image-/ { image[++images] = $1; version[images] = $2; at[images] = NR }
        END {
            for (i = images; i > 0; --i) {
                release = substr(image[i], length("linux-image-") + 1)
                split(version[i], part, ".")
                headers = "linux-headers-" release
                common = substr(headers, 1, length(headers) - length("amd64")) "common"
                kbuild = "linux-kbuild-" part[1] "." part[2]
                tools = has[kbuild, version[i]] ? version[i] : rank[kbuild] > at[i] ? newest[kbuild] : ""
                if (tools != "" && has[headers, version[i]] && has[common, version[i]] && has["linux-source-" part[1] "." part[2], version[i]]) {
                    if (!told[image[i], version[i]]++) { print release, version[i], kbuild "=" tools }
                }
            }
        }'
}

# fetch FOLDER PACKAGE[=VERSION]...: their .deb files into FOLDER.
fetch() {
    local folder=$1
    shift
    mkdir -p "$folder"
    (cd "$folder" && apt-get "${apt_options[@]}" --quiet=2 download "$@")
}
