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

# fetch FOLDER PACKAGE[=VERSION]...: their .deb files into FOLDER.
fetch() {
    local folder=$1
    shift
    mkdir -p "$folder"
    (cd "$folder" && apt-get "${apt_options[@]}" --quiet=2 download "$@")
}
