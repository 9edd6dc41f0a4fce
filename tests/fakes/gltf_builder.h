#pragma once

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "base/image.h"
#include "base/json.h"

namespace foveray::fakes {

/// A glTF file in the making: `json` is the document, the functions append to it and to one buffer.
class GltfBuilder {
  public:
    Json json = {{"asset", {{"version", "2.0"}}}, {"scene", 0}};
    std::vector<std::uint8_t> bytes;

    /// Appends to an array of the document; returns the element's index.
    int add(const std::string& array, const Json& element) {
        json[array].push_back(element);
        return static_cast<int>(json[array].size()) - 1;
    }

    template <typename T>
    int add_view(const std::vector<T>& values) {
        bytes.resize((bytes.size() + 3) / 4 * 4);
        const std::size_t offset = bytes.size(), length = values.size() * sizeof(T);
        bytes.resize(offset + length);
        std::memcpy(bytes.data() + offset, values.data(), length);
        return add("bufferViews", {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", length}});
    }

    /// type: "SCALAR", "VEC3" …; the component type follows T.
    template <typename T>
    int add_accessor(const std::vector<T>& values, const std::string& type, bool normalized = false) {
        Json accessor = {{"bufferView", add_view(values)},
                         {"componentType", component_type<T>()},
                         {"count", values.size() / components(type)},
                         {"type", type}};
        if (normalized) accessor["normalized"] = true;
        return add("accessors", accessor);
    }

    /// An image inside the buffer; returns its index in "images".
    int add_image(const Image& rgba) {
        return add("images", {{"bufferView", add_view(tga(rgba))}, {"mimeType", "image/png"}});
    }

    /// A mesh of one primitive; returns the mesh's index.
    int add_mesh(const Json& primitive) { return add("meshes", {{"primitives", Json::array({primitive})}}); }

    /// A node among the roots of scene 0; returns the node's index.
    int add_root(const Json& node) {
        const int id = add("nodes", node);
        json["scenes"][0]["nodes"].push_back(id);
        return id;
    }

    std::string text() const {
        Json document = json;
        if (!bytes.empty()) {
            document["buffers"] = Json::array({{{"byteLength", bytes.size()}, {"uri", data_uri(bytes)}}});
        }
        return document.dump();
    }

    /// The same as a binary glTF.
    std::string binary() const {
        Json document = json;
        document["buffers"] = Json::array({{{"byteLength", bytes.size()}}});
        std::string text = document.dump();
        text.resize((text.size() + 3) / 4 * 4, ' ');
        std::string data(bytes.begin(), bytes.end());
        data.resize((data.size() + 3) / 4 * 4, '\0');
        std::string out = "glTF" + word(2) + word(12 + 8 + text.size() + 8 + data.size());
        out += word(text.size()) + "JSON" + text;
        out += word(data.size()) + std::string("BIN\0", 4) + data;
        return out;
    }

    /// A right triangle in the xy plane that faces +z: (0,0,0), (1,0,0), (0,1,0).
    static GltfBuilder triangle() {
        GltfBuilder gltf;
        const int positions = gltf.add_accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
        gltf.add_root({{"mesh", gltf.add_mesh({{"attributes", {{"POSITION", positions}}}})}});
        return gltf;
    }

    Json& primitive() { return json["meshes"][0]["primitives"][0]; }

    static std::string data_uri(const std::vector<std::uint8_t>& data) {
        static constexpr char alphabet[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        std::string out = "data:application/octet-stream;base64,";
        for (std::size_t i = 0; i < data.size(); i += 3) {
            const auto byte = [&](std::size_t k) {
                return i + k < data.size() ? std::uint32_t{data[i + k]} : 0u;
            };
            const std::uint32_t bits = byte(0) << 16 | byte(1) << 8 | byte(2);
            for (std::size_t k = 0; k < 4; ++k) {
                out += i + k > data.size() ? '=' : alphabet[bits >> (18 - 6 * k) & 63];
            }
        }
        return out;
    }

    /// An uncompressed 32-bit TGA file, rows from the top.
    static std::vector<std::uint8_t> tga(const Image& rgba) {
        std::vector<std::uint8_t> out(18, 0);
        out[2] = 2;
        out[12] = static_cast<std::uint8_t>(rgba.width), out[13] = static_cast<std::uint8_t>(rgba.width >> 8);
        out[14] = static_cast<std::uint8_t>(rgba.height),
        out[15] = static_cast<std::uint8_t>(rgba.height >> 8);
        out[16] = 32, out[17] = 0x28;
        for (std::size_t i = 0; i < rgba.pixels.size(); i += 4) {
            for (const std::size_t c : {2u, 1u, 0u, 3u}) out.push_back(rgba.pixels[i + c]);
        }
        return out;
    }

  private:
    static std::string word(std::size_t value) {
        const auto v = static_cast<std::uint32_t>(value);
        return {reinterpret_cast<const char*>(&v), 4};
    }
    template <typename T>
    static int component_type() {
        if constexpr (std::is_same_v<T, std::int8_t>) return 5120;
        if constexpr (std::is_same_v<T, std::uint8_t>) return 5121;
        if constexpr (std::is_same_v<T, std::int16_t>) return 5122;
        if constexpr (std::is_same_v<T, std::uint16_t>) return 5123;
        if constexpr (std::is_same_v<T, std::uint32_t>) return 5125;
        return 5126;
    }
    static std::size_t components(const std::string& type) {
        return type == "SCALAR" ? 1 : type == "MAT4" ? 16 : static_cast<std::size_t>(type.back() - '0');
    }
};

}  // namespace foveray::fakes
