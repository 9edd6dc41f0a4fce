#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "base/json.h"
#include "base/math.h"
#include "render/scene/tinygltf.h"

namespace foveray::scene {

/// A glTF file in memory, checked so far that every index in it points at something. `place` is a JSON
/// pointer.
struct GltfDocument {
    std::filesystem::path file;
    Json json;                                       // as in the file
    tinygltf::Model model;                           // without buffers and images: those are below
    std::vector<std::vector<std::uint8_t>> buffers;  // each at least as long as its byteLength
    std::vector<std::string> ignored_extensions;     // used, optional, not supported

    /// Throws Fault(BadInput) "file: place: what (remedy)".
    [[noreturn]] void fault(const std::string& place, const std::string& what,
                            const std::string& remedy = "export the file again or mend it there") const;
};

/// Reads a .gltf or .glb file and its buffers. Throws Fault(BadInput).
GltfDocument read_gltf(const std::filesystem::path& file);

/// The bytes of a buffer view.
std::span<const std::uint8_t> view_bytes(const GltfDocument& document, std::size_t buffer_view);

/// The file that a "uri" names, relative to the document.
std::filesystem::path path_of(const GltfDocument& document, const std::string& uri);

/// The bytes behind a "uri": a base64 data URI or a file next to the document.
std::vector<std::uint8_t> read_uri(const GltfDocument& document, const std::string& uri,
                                   const std::string& place);

/// `count * width` floats of an accessor with `width` components: normalised integers mapped to [-1, 1] or
/// [0, 1], sparse substitutions made. Throws Fault(BadInput) when it reaches past its buffer or holds a NaN
/// or infinity.
std::vector<float> read_floats(const GltfDocument& document, int accessor, std::uint32_t width,
                               const std::string& place);
/// The same for unsigned integers (indices, joints).
std::vector<std::uint32_t> read_integers(const GltfDocument& document, int accessor, std::uint32_t width,
                                         const std::string& place);
std::vector<vec2> read_vec2(const GltfDocument& document, int accessor, const std::string& place);
std::vector<vec3> read_vec3(const GltfDocument& document, int accessor, const std::string& place);
std::vector<vec4> read_vec4(const GltfDocument& document, int accessor, const std::string& place);

/// Components of an accessor's elements: 1 for SCALAR, 4 for VEC4, 16 for MAT4.
std::uint32_t component_count(const GltfDocument& document, int accessor);

}  // namespace foveray::scene
