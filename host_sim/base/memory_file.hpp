// SPDX-License-Identifier: MIT
// MemoryFile: a text as a file that is on no disk.
#pragma once

#include <string>
#include <string_view>

namespace splinefeed::host {

/// Whatever reads files reads the text by its path, as often as it likes, as long as the object exists.
class MemoryFile {
public:
    /// Throws std::system_error where there is no memory for it.
    explicit MemoryFile(std::string_view text);
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;
    ~MemoryFile();

    [[nodiscard]] std::string path() const;

private:
    int descriptor_;
};

} // namespace splinefeed::host
