# SPDX-License-Identifier: MIT
# Writes OUTPUT, a source that holds the drive profiles FILES (joined by |) as texts, in order of their names.
string(REPLACE "|" ";" files "${FILES}")
set(code "// Made from hal/profiles/*.toml by cmake/embed_profiles.cmake.\n#include \"host_sim/config/shipped_profiles.hpp\"\n\n#include <array>\n\nnamespace splinefeed::host {\n\nnamespace {\n\nconstexpr std::array shipped{\n")
foreach(file IN LISTS files)
    get_filename_component(name "${file}" NAME_WE)
    file(READ "${file}" text)
    string(APPEND code "    ShippedProfile{\"${name}\", R\"profile(${text})profile\"},\n")
endforeach()
string(APPEND code "};\n\n} // namespace\n\nstd::span<const ShippedProfile> shipped_profiles() noexcept {\n    return shipped;\n}\n\n} // namespace splinefeed::host\n")
file(WRITE "${OUTPUT}" "${code}")
