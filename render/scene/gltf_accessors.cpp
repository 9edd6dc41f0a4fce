#include <cmath>
#include <cstring>
#include <limits>

#include "render/scene/gltf_document.h"

namespace foveray::scene {
namespace {

// No view bounds an accessor of zeros, so this does.
constexpr std::size_t most_elements_without_view = std::size_t{1} << 26;

std::size_t component_size(int type) {
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return 1;
        case TINYGLTF_COMPONENT_TYPE_SHORT:
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return 2;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        case TINYGLTF_COMPONENT_TYPE_FLOAT:
            return 4;
        default:
            return 0;
    }
}

template <typename T>
T load(const std::uint8_t* at) {
    T value;
    std::memcpy(&value, at, sizeof(T));
    return value;
}

/// glTF 2.0 section 3.11 (normalised integers) and KHR_mesh_quantization.
template <typename T>
float decode(const std::uint8_t* at, bool normalized) {
    const auto value = static_cast<float>(load<T>(at));
    if (!normalized) return value;
    return std::max(value / static_cast<float>(std::numeric_limits<T>::max()), -1.0f);
}

float load_float(const std::uint8_t* at, int type, bool normalized) {
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return decode<std::int8_t>(at, normalized);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return decode<std::uint8_t>(at, normalized);
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return decode<std::int16_t>(at, normalized);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return decode<std::uint16_t>(at, normalized);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            return decode<std::uint32_t>(at, normalized);
        default:
            return load<float>(at);
    }
}

bool is_unsigned(int type) {
    return type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE || type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
           type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

std::uint32_t load_integer(const std::uint8_t* at, int type) {
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return load<std::uint8_t>(at);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return load<std::uint16_t>(at);
        default:
            return load<std::uint32_t>(at);
    }
}

/// `count` elements of `size` bytes, `stride` apart, at `offset` in a buffer view, checked to lie inside it.
const std::uint8_t* elements(const GltfDocument& document, int view, std::size_t offset, std::size_t stride,
                             std::size_t count, std::size_t size, const std::string& place) {
    const auto bytes = view_bytes(document, static_cast<std::size_t>(view));
    const bool inside = count == 0 || (offset <= bytes.size() && size <= bytes.size() - offset &&
                                       (count - 1) <= (bytes.size() - offset - size) / stride);
    if (!inside) {
        document.fault(place,
                       "reaches past the " + std::to_string(bytes.size()) + " bytes of its buffer view");
    }
    return bytes.data() + offset;
}

/// Reads every component with load(pointer, component type) after the checks that floats and integers share.
template <typename T, typename Load>
std::vector<T> read(const GltfDocument& document, int id, std::uint32_t width, const std::string& place,
                    const Load& load_component) {
    const tinygltf::Accessor& a = document.model.accessors[static_cast<std::size_t>(id)];
    const std::string where = place + " (accessor " + std::to_string(id) + ")";
    const std::size_t bytes = component_size(a.componentType);
    if (bytes == 0) document.fault(where, "has a component type that glTF does not allow");
    if (component_count(document, id) != width) {
        document.fault(where, "must have " + std::to_string(width) + " components an element");
    }
    if (a.count == 0) document.fault(where, "is empty");

    std::vector<T> out;
    const std::size_t size = bytes * width;
    if (a.bufferView >= 0) {
        const std::size_t given =
            document.model.bufferViews[static_cast<std::size_t>(a.bufferView)].byteStride;
        const std::size_t stride = given == 0 ? size : given;
        if (stride < size) document.fault(where, "has a byteStride smaller than its elements");
        const std::uint8_t* first =
            elements(document, a.bufferView, a.byteOffset, stride, a.count, size, where);
        out.reserve(a.count * width);
        for (std::size_t i = 0; i < a.count; ++i) {
            for (std::uint32_t c = 0; c < width; ++c) {
                out.push_back(load_component(first + i * stride + c * bytes, a.componentType));
            }
        }
    } else {
        if (a.count > most_elements_without_view) document.fault(where, "is unreasonably long");
        out.assign(a.count * width, T{});
    }

    if (!a.sparse.isSparse) return out;
    if (a.sparse.count < 0 || a.sparse.indices.byteOffset < 0 || a.sparse.values.byteOffset < 0) {
        document.fault(where, "has a negative count or offset in its sparse part");
    }
    const auto count = static_cast<std::size_t>(a.sparse.count);
    const int index_type = a.sparse.indices.componentType;
    const std::size_t index_size = component_size(index_type);
    if (!is_unsigned(index_type)) document.fault(where, "has sparse indices of a wrong component type");
    const std::uint8_t* indices =
        elements(document, a.sparse.indices.bufferView, static_cast<std::size_t>(a.sparse.indices.byteOffset),
                 index_size, count, index_size, where + " sparse indices");
    const std::uint8_t* values =
        elements(document, a.sparse.values.bufferView, static_cast<std::size_t>(a.sparse.values.byteOffset),
                 size, count, size, where + " sparse values");
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t index = load_integer(indices + i * index_size, index_type);
        if (index >= a.count) document.fault(where, "has a sparse index past its end");
        for (std::uint32_t c = 0; c < width; ++c) {
            out[index * width + c] = load_component(values + i * size + c * bytes, a.componentType);
        }
    }
    return out;
}

template <typename Vector>
std::vector<Vector> read_vectors(const GltfDocument& document, int accessor, const std::string& place) {
    const std::vector<float> floats = read_floats(document, accessor, Vector::length(), place);
    std::vector<Vector> out(floats.size() / Vector::length());
    std::memcpy(out.data(), floats.data(), floats.size() * sizeof(float));
    return out;
}

}  // namespace

std::uint32_t component_count(const GltfDocument& document, int accessor) {
    const int type = document.model.accessors[static_cast<std::size_t>(accessor)].type;
    return static_cast<std::uint32_t>(tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(type)));
}

std::vector<float> read_floats(const GltfDocument& document, int accessor, std::uint32_t width,
                               const std::string& place) {
    const bool normalized = document.model.accessors[static_cast<std::size_t>(accessor)].normalized;
    std::vector<float> out =
        read<float>(document, accessor, width, place,
                    [&](const std::uint8_t* at, int type) { return load_float(at, type, normalized); });
    for (std::size_t i = 0; i < out.size(); ++i) {
        if (!std::isfinite(out[i])) {
            document.fault(place,
                           "holds a number that is not finite in element " + std::to_string(i / width));
        }
    }
    return out;
}

std::vector<std::uint32_t> read_integers(const GltfDocument& document, int accessor, std::uint32_t width,
                                         const std::string& place) {
    const int type = document.model.accessors[static_cast<std::size_t>(accessor)].componentType;
    if (!is_unsigned(type)) {
        document.fault(place, "must hold unsigned integers");
    }
    return read<std::uint32_t>(document, accessor, width, place,
                               [](const std::uint8_t* at, int t) { return load_integer(at, t); });
}

std::vector<vec2> read_vec2(const GltfDocument& document, int accessor, const std::string& place) {
    return read_vectors<vec2>(document, accessor, place);
}
std::vector<vec3> read_vec3(const GltfDocument& document, int accessor, const std::string& place) {
    return read_vectors<vec3>(document, accessor, place);
}
std::vector<vec4> read_vec4(const GltfDocument& document, int accessor, const std::string& place) {
    return read_vectors<vec4>(document, accessor, place);
}

}  // namespace foveray::scene
