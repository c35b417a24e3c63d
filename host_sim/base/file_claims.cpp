// SPDX-License-Identifier: MIT
//
// An input is kept open, so that its inode is not given to another file while the call lasts. An output that does not
// exist yet is known by its folder and its name there.
#include "host_sim/base/file_claims.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/base/output_file.hpp"

#include <cassert>
#include <filesystem>
#include <mutex>
#include <optional>
#include <vector>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace splinefeed::host {

namespace {

struct Identity {
    dev_t device = 0;
    ino_t inode = 0;
    std::string entry; ///< of a file that does not exist yet: its name in that folder

    friend bool operator==(const Identity&, const Identity&) = default;
};

struct Claim {
    Identity identity;
    std::string name;   ///< as it was given
    int kept = -1;      ///< an input's descriptor; of an output there is none
    bool state = false; ///< an output that is read before
};

struct Claims {
    std::mutex mutex;
    bool active = false;
    std::vector<Claim> all;
};

Claims& claims() {
    static Claims all;
    return all;
}

std::optional<Identity> file_identity(const struct stat& status) {
    return S_ISREG(status.st_mode) ? std::optional(Identity{status.st_dev, status.st_ino, {}}) : std::nullopt;
}

/// Nothing where there is nothing to lose, or no folder for it.
std::optional<Identity> identity_at(const std::string& path) {
    struct stat status {};
    if (path == "-") {
        return fstat(STDOUT_FILENO, &status) == 0 ? file_identity(status) : std::nullopt;
    }
    if (stat(path.c_str(), &status) == 0) {
        return file_identity(status);
    }
    const std::filesystem::path named(path);
    const std::string folder = named.has_parent_path() ? named.parent_path().string() : ".";
    if (stat(folder.c_str(), &status) != 0) {
        return std::nullopt;
    }
    return Identity{status.st_dev, status.st_ino, named.filename().string()};
}

std::string shown(const std::string& name, const char* standard) {
    return name == "-" ? standard : name;
}

} // namespace

FileClaims::FileClaims() {
    const std::lock_guard lock(claims().mutex);
    assert(!claims().active);
    claims().active = true;
}

FileClaims::~FileClaims() {
    const std::lock_guard lock(claims().mutex);
    for (const Claim& claim : claims().all) {
        if (claim.kept >= 0) {
            close(claim.kept);
        }
    }
    claims().all.clear();
    claims().active = false;
}

void FileClaims::reads(int descriptor, const std::string& name) {
    Claims& known = claims();
    const std::lock_guard lock(known.mutex);
    struct stat status {};
    if (!known.active || fstat(descriptor, &status) != 0) {
        return;
    }
    const std::optional<Identity> identity = file_identity(status);
    if (!identity) {
        return;
    }
    for (const Claim& claim : known.all) {
        if (!(claim.identity == *identity)) {
            continue;
        }
        if (claim.kept >= 0 || (claim.state && claim.name == name)) {
            return; // read once more
        }
        throw InputError(name, 0,
                         "it is the output {} as well, which would replace it; give the output a name of "
                         "its own",
                         shown(claim.name, "on standard output"));
    }
    known.all.push_back({*identity, name, fcntl(descriptor, F_DUPFD_CLOEXEC, 0)});
}

void FileClaims::writes(const std::string& path) {
    claim_output(path, false);
}

void FileClaims::keeps(const std::string& path) {
    claim_output(path, true);
}

void FileClaims::claim_output(const std::string& path, bool state) {
    Claims& known = claims();
    const std::lock_guard lock(known.mutex);
    const std::optional<Identity> identity = known.active ? identity_at(path) : std::nullopt;
    if (!identity) {
        return;
    }
    const std::string output = shown(path, "standard output");
    for (const Claim& claim : known.all) {
        if (!(claim.identity == *identity)) {
            continue;
        }
        if (claim.kept >= 0) {
            throw OutputError("{}: it is the input {} as well, which would be lost; give the output a name "
                              "of its own",
                              output, shown(claim.name, "on standard input"));
        }
        if ((path == "-" && claim.name == "-") || (state && claim.state && claim.name == path)) {
            return; // one after another
        }
        throw OutputError("{}: it is the same file as the output {}; give each its own", output,
                          shown(claim.name, "on standard output"));
    }
    known.all.push_back({*identity, path, -1, state});
}

bool FileClaims::is_input(const std::string& path) noexcept {
    Claims& known = claims();
    const std::lock_guard lock(known.mutex);
    struct stat status {};
    if (stat(path.c_str(), &status) != 0) {
        return false;
    }
    for (const Claim& claim : known.all) {
        if (claim.kept >= 0 && claim.identity.device == status.st_dev && claim.identity.inode == status.st_ino) {
            return true;
        }
    }
    return false;
}

} // namespace splinefeed::host
