#include "render/scene/gltf_document.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <iterator>
#include <optional>
#include <string_view>

#include "base/error.h"
#include "render/scene/gltf_references.h"

namespace foveray::scene {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::array supported_extensions = {
    std::string_view("KHR_lights_punctual"),   std::string_view("KHR_texture_transform"),
    std::string_view("KHR_materials_unlit"),   std::string_view("KHR_materials_emissive_strength"),
    std::string_view("KHR_mesh_quantization"), std::string_view("EXT_mesh_gpu_instancing"),
    std::string_view("KHR_materials_ior"),     std::string_view("KHR_materials_transmission"),
    std::string_view("KHR_materials_volume")};

std::optional<Bytes> read_bytes(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    if (!in || std::filesystem::is_directory(file)) return std::nullopt;
    return Bytes(std::istreambuf_iterator<char>(in), {});
}

struct Chunks {
    std::string_view json;
    std::optional<std::span<const std::uint8_t>> binary;
};

/// glTF 2.0 section 4.4: a 12-byte header, then chunks of length, type and data.
Chunks split(const GltfDocument& document, std::span<const std::uint8_t> bytes) {
    const auto text = [](std::span<const std::uint8_t> s) {
        return std::string_view(reinterpret_cast<const char*>(s.data()), s.size());
    };
    if (!text(bytes).starts_with("glTF")) return {text(bytes), std::nullopt};

    const auto word = [&](std::size_t at) {
        if (at + 4 > bytes.size())
            document.fault("byte " + std::to_string(at), "the file ends in the middle",
                           "get a whole copy of it");
        std::uint32_t value = 0;
        std::memcpy(&value, &bytes[at], 4);
        return std::size_t{value};
    };
    if (word(4) != 2)
        document.fault("byte 4", "is glTF version " + std::to_string(word(4)), "convert it to glTF 2.0");
    Chunks chunks;
    for (std::size_t at = 12; at < std::min(word(8), bytes.size());) {
        const std::size_t length = word(at), type = word(at + 4);
        if (length > bytes.size() - at - 8) {
            document.fault("byte " + std::to_string(at), "the file ends in the middle of a chunk",
                           "get a whole copy of it");
        }
        const auto data = bytes.subspan(at + 8, length);
        if (type == 0x4E4F534A && chunks.json.empty()) chunks.json = text(data);
        if (type == 0x004E4942 && !chunks.binary) chunks.binary = data;
        at += 8 + length;
    }
    if (word(8) > bytes.size())
        document.fault("byte 8", "the file ends before its stated length", "get a whole copy of it");
    if (chunks.json.empty()) document.fault("byte 12", "has no JSON chunk");
    return chunks;
}

/// tinygltf goes through extras by recursion, so nesting must be bounded before it sees them.
bool is_too_deep(std::string_view text) {
    constexpr int deepest = 128;
    int depth = 0;
    bool in_string = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (in_string) {
            if (c == '\\') ++i;
            if (c == '"') in_string = false;
        } else if (c == '"') {
            in_string = true;
        } else if (c == '{' || c == '[') {
            if (++depth > deepest) return true;
        } else if (c == '}' || c == ']') {
            --depth;
        }
    }
    return false;
}

Json parse_json(const GltfDocument& document, std::string_view text) {
    if (is_too_deep(text)) document.fault("/", "is nested too deeply");
    try {
        Json json = Json::parse(text);
        if (!json.is_object()) document.fault("/", "must be an object");
        return json;
    } catch (const Json::parse_error& e) {
        const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(e.byte, text.size()));
        throw_bad_input(
            document.file.string() + ":" + std::to_string(1 + std::count(text.begin(), end, '\n')),
            "not valid JSON", "get a whole copy of the file or correct the syntax there");
    } catch (const Json::exception&) {
        document.fault("/", "holds a number that is too large");
    }
}

std::vector<std::string> strings(const GltfDocument& document, const std::string& key) {
    std::vector<std::string> out;
    const Json list = document.json.value(key, Json::array());
    if (!list.is_array()) document.fault("/" + key, "must be an array");
    for (const Json& name : list) {
        if (!name.is_string()) document.fault("/" + key, "must be an array of names");
        out.push_back(name);
    }
    return out;
}

void check_header(GltfDocument& document) {
    const Json asset = document.json.value("asset", Json());
    const Json version = asset.is_object() ? asset.value("version", Json()) : Json();
    if (!version.is_string()) document.fault("/asset/version", "is missing", "is this a glTF file?");
    if (!version.get<std::string>().starts_with("2.")) {
        document.fault("/asset/version", "is " + version.dump(), "convert the file to glTF 2.0");
    }
    const auto supported = [](const std::string& name) {
        return std::ranges::find(supported_extensions, name) != supported_extensions.end();
    };
    std::string missing;
    for (const std::string& name : strings(document, "extensionsRequired")) {
        if (!supported(name)) missing += (missing.empty() ? "" : ", ") + name;
    }
    if (!missing.empty()) {
        document.fault("/extensionsRequired", "needs what foveray does not support: " + missing,
                       "export the model without it");
    }
    for (const std::string& name : strings(document, "extensionsUsed")) {
        if (!supported(name)) document.ignored_extensions.push_back(name);
    }
}

std::uint64_t size_at(const GltfDocument& document, const Json& object, const char* key,
                      const std::string& place, std::optional<std::uint64_t> otherwise = std::nullopt) {
    if (!object.contains(key)) {
        if (otherwise) return *otherwise;
        document.fault(place + "/" + key, "is missing");
    }
    if (!object[key].is_number_unsigned())
        document.fault(place + "/" + key, "must be a whole number from 0 up");
    return object[key];
}

void load_buffers(GltfDocument& document, const Chunks& chunks) {
    const Json buffers = document.json.value("buffers", Json::array());
    for (std::size_t i = 0; i < buffers.size(); ++i) {
        const std::string place = "/buffers/" + std::to_string(i);
        const std::uint64_t length = size_at(document, buffers[i], "byteLength", place);
        Bytes data;
        if (buffers[i].contains("uri")) {
            if (!buffers[i]["uri"].is_string()) document.fault(place + "/uri", "must be a string");
            data = read_uri(document, buffers[i]["uri"], place + "/uri");
        } else if (i == 0 && chunks.binary) {
            data.assign(chunks.binary->begin(), chunks.binary->end());
        } else {
            document.fault(place, "has no data: no uri, and the file no binary chunk for it");
        }
        if (data.size() < length) {
            document.fault(place,
                           "holds " + std::to_string(data.size()) + " bytes, not the " +
                               std::to_string(length) + " of its byteLength",
                           "get a whole copy of the file");
        }
        document.buffers.push_back(std::move(data));
    }
}

void check_views(const GltfDocument& document) {
    const Json views = document.json.value("bufferViews", Json::array());
    for (std::size_t i = 0; i < views.size(); ++i) {
        const std::string place = "/bufferViews/" + std::to_string(i);
        if (!views[i].contains("buffer")) document.fault(place + "/buffer", "is missing");
        const std::uint64_t offset = size_at(document, views[i], "byteOffset", place, 0);
        const std::uint64_t length = size_at(document, views[i], "byteLength", place);
        const std::uint64_t size = document.buffers[views[i]["buffer"].get<std::size_t>()].size();
        if (length > size || offset > size - length) {
            document.fault(place, "reaches past the " + std::to_string(size) + " bytes of its buffer");
        }
    }
}

/// Elements that tinygltf leaves out without a word would shift all later indices.
void check_nothing_lost(const GltfDocument& document) {
    const Json meshes = document.json.value("meshes", Json::array());
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        const Json primitives = meshes[i].value("primitives", Json::array());
        for (std::size_t j = 0; j < primitives.size(); ++j) {
            const std::string place = "/meshes/" + std::to_string(i) + "/primitives/" + std::to_string(j);
            if (!primitives[j].is_object()) document.fault(place, "must be an object");
            if (!primitives[j].value("attributes", Json()).is_object()) {
                document.fault(place + "/attributes", "must be an object");
            }
        }
        if (document.model.meshes[i].primitives.size() != primitives.size()) {
            document.fault("/meshes/" + std::to_string(i), "has a primitive that cannot be read");
        }
    }
}

void parse_model(GltfDocument& document) {
    Json rest = document.json;
    rest.erase("buffers");
    rest.erase("images");
    tinygltf::TinyGLTF parser;
    std::string error, warning;
    const std::string text = rest.dump();
    const bool parsed = parser.LoadASCIIFromString(&document.model, &error, &warning, text.c_str(),
                                                   static_cast<unsigned>(text.size()), "");
    std::ranges::replace(error, '\n', ' ');
    if (!parsed) document.fault("/", error.empty() ? "cannot be read" : error);
    check_nothing_lost(document);
}

/// RFC 4648; stops at padding. nullopt: a character that does not belong.
std::optional<Bytes> decode_base64(std::string_view text) {
    constexpr std::string_view alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    Bytes out;
    std::uint32_t bits = 0;
    int count = 0;
    for (const char c : text) {
        if (c == '=') break;
        const std::size_t value = alphabet.find(c);
        if (value == alphabet.npos) return std::nullopt;
        bits = bits << 6 | static_cast<std::uint32_t>(value);
        if ((count += 6) >= 8) {
            count -= 8;
            out.push_back(static_cast<std::uint8_t>(bits >> count));
        }
    }
    return out;
}

std::string decode_percent(std::string_view uri) {
    const auto digit = [](char c) {
        if (c >= '0' && c <= '9') return c - '0';
        const char lower = static_cast<char>(c | 0x20);
        return lower >= 'a' && lower <= 'f' ? lower - 'a' + 10 : -1;
    };
    std::string out;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        const bool escape =
            uri[i] == '%' && i + 2 < uri.size() && digit(uri[i + 1]) >= 0 && digit(uri[i + 2]) >= 0;
        out += escape ? static_cast<char>(16 * digit(uri[i + 1]) + digit(uri[i + 2])) : uri[i];
        if (escape) i += 2;
    }
    return out;
}

}  // namespace

void GltfDocument::fault(const std::string& place, const std::string& what, const std::string& remedy) const {
    throw_bad_input(file.string() + ": " + place, what, remedy);
}

GltfDocument read_gltf(const std::filesystem::path& file) {
    GltfDocument document;
    document.file = file;
    const std::optional<Bytes> bytes = read_bytes(file);
    if (!bytes) throw_bad_input(file.string(), "cannot be opened", "check the path");
    const Chunks chunks = split(document, *bytes);
    document.json = parse_json(document, chunks.json);
    try {
        check_header(document);
        check_references(document);
        load_buffers(document, chunks);
        check_views(document);
        parse_model(document);
    } catch (const Json::exception& e) {  // a value of another type than glTF has there
        document.fault("/", e.what());
    }
    return document;
}

std::span<const std::uint8_t> view_bytes(const GltfDocument& document, std::size_t buffer_view) {
    const tinygltf::BufferView& view = document.model.bufferViews[buffer_view];
    return std::span(document.buffers[static_cast<std::size_t>(view.buffer)])
        .subspan(view.byteOffset, view.byteLength);
}

std::filesystem::path path_of(const GltfDocument& document, const std::string& uri) {
    return document.file.parent_path() / decode_percent(uri);
}

std::vector<std::uint8_t> read_uri(const GltfDocument& document, const std::string& uri,
                                   const std::string& place) {
    if (uri.starts_with("data:")) {
        const std::size_t comma = uri.find(',');
        const bool base64 = comma != uri.npos && std::string_view(uri).substr(0, comma).ends_with(";base64");
        const auto data = base64 ? decode_base64(std::string_view(uri).substr(comma + 1)) : std::nullopt;
        if (!data) document.fault(place, "is not a base64 data URI");
        return *data;
    }
    const std::filesystem::path file = path_of(document, uri);
    std::optional<Bytes> data = read_bytes(file);
    if (!data)
        document.fault(place, file.string() + " cannot be opened", "put the file there or correct the uri");
    return std::move(*data);
}

}  // namespace foveray::scene
