// Reads plain OBJ text fast, on several threads. Most large files are plain.
#pragma once
#include <cstddef>
#include <optional>
#include <string_view>

#include "mesh/obj.hpp"
#include "mesh/triangle_mesh.hpp"

namespace pliant {

/// Reads positions and faces as parse_obj() does, from text that is cut at line ends into `part_count` parts, one a thread. The
/// mesh does not depend on their number. Returns nothing if there is no face, or if a line is not plain, be it wrong or only
/// unusual: numbers with a plus sign, indices that count backwards, lines that go on behind a backslash, and the like.
[[nodiscard]] std::optional<TriangleMesh> read_plain_obj(std::string_view text, std::size_t part_count,
                                                         const ReadProgress& progress = {});

}  // namespace pliant
