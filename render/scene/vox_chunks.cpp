#include "render/scene/vox_chunks.h"

#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <span>
#include <sstream>

#include "base/error.h"
#include "base/image.h"

namespace foveray::scene {
namespace {

using Bytes = std::span<const std::uint8_t>;
using Dictionary = std::map<std::string, std::string>;

class VoxReader {
  public:
    explicit VoxReader(const std::filesystem::path& file) : file_(file.string()) {}

    VoxFile read(Bytes bytes) {
        out_.palette = default_palette();
        if (take_text(bytes, 4) != "VOX ") fault("it does not begin with \"VOX \"");
        const std::int32_t version = take_int(bytes);
        if (version < 150) fault("its version is " + std::to_string(version));
        Chunk main = take_chunk(bytes);
        if (main.id != "MAIN") fault("its first chunk is not MAIN");
        while (!main.children.empty()) {
            const Chunk chunk = take_chunk(main.children);
            read_chunk(chunk.id, chunk.content);
        }
        if (pending_size_) fault("its last model has no XYZI chunk");
        if (out_.models.empty()) fault("there is no model in it");
        check_nodes();
        return std::move(out_);
    }

  private:
    struct Chunk {
        std::string id;
        Bytes content, children;
    };

    [[noreturn]] void fault(const std::string& what) const {
        throw_bad_input(file_, what, "take a file that MagicaVoxel saved");
    }

    Bytes take(Bytes& from, std::int64_t count) const {
        if (count < 0 || static_cast<std::uint64_t>(count) > from.size()) {
            fault("it is cut short, or a size in it is wrong");
        }
        const Bytes taken = from.first(static_cast<std::size_t>(count));
        from = from.subspan(taken.size());
        return taken;
    }

    std::int32_t take_int(Bytes& from) const {
        const Bytes b = take(from, 4);
        return static_cast<std::int32_t>(std::uint32_t{b[0]} | std::uint32_t{b[1]} << 8 |
                                         std::uint32_t{b[2]} << 16 | std::uint32_t{b[3]} << 24);
    }

    std::string take_text(Bytes& from, std::int64_t length) const {
        const Bytes b = take(from, length);
        return {b.begin(), b.end()};
    }

    Dictionary take_dictionary(Bytes& from) const {
        Dictionary d;
        for (std::int32_t left = take_int(from); left > 0; --left) {
            std::string key = take_text(from, take_int(from));
            d[std::move(key)] = take_text(from, take_int(from));
        }
        return d;
    }

    Chunk take_chunk(Bytes& from) const {
        Chunk chunk;
        chunk.id = take_text(from, 4);
        const std::int32_t content = take_int(from), children = take_int(from);
        chunk.content = take(from, content);
        chunk.children = take(from, children);
        return chunk;
    }

    void read_chunk(const std::string& id, Bytes content) {
        if (id == "SIZE") read_size(content);
        if (id == "XYZI") read_voxels(content);
        if (id == "RGBA") read_palette(content);
        if (id == "nTRN") read_transform(content);
        if (id == "nGRP") read_group(content);
        if (id == "nSHP") read_shape(content);
    }

    void read_size(Bytes content) {
        if (pending_size_) fault("a model has no XYZI chunk");
        VoxFile::Model model;
        for (int axis = 0; axis < 3; ++axis) {
            const auto size = static_cast<std::uint32_t>(take_int(content));
            if (size < 1 || size > 256) {
                fault("a model is " + std::to_string(size) + " voxels wide, not 1 to 256");
            }
            model.size[axis] = static_cast<std::int32_t>(size);
        }
        out_.models.push_back(std::move(model));
        pending_size_ = true;
    }

    void read_voxels(Bytes content) {
        if (!pending_size_) fault("an XYZI chunk has no SIZE chunk before it");
        pending_size_ = false;
        VoxFile::Model& model = out_.models.back();
        const auto count = static_cast<std::uint32_t>(take_int(content));
        const Bytes voxels = take(content, std::int64_t{4} * count);
        model.voxels.reserve(count);
        for (std::size_t i = 0; i < voxels.size(); i += 4) {
            const VoxFile::Voxel v{voxels[i], voxels[i + 1], voxels[i + 2], voxels[i + 3]};
            if (v.x >= model.size.x || v.y >= model.size.y || v.z >= model.size.z) {
                fault("a voxel lies outside its model");
            }
            if (v.color == 0) fault("a voxel has colour 0, which means no voxel");
            model.voxels.push_back(v);
        }
    }

    void read_palette(Bytes content) {
        const Bytes colors = take(content, 1024);
        for (std::size_t i = 0; i + 1 < 256; ++i) {
            for (std::size_t c = 0; c < 3; ++c) {
                out_.palette[i + 1][static_cast<int>(c)] =
                    linear_from_srgb(static_cast<float>(colors[4 * i + c]) / 255.0f);
            }
        }
    }

    void read_transform(Bytes content) {
        const std::int32_t id = take_int(content);
        const Dictionary attributes = take_dictionary(content);
        VoxFile::Node node;
        node.kind = VoxFile::Node::Kind::Transform;
        node.hidden = attributes.contains("_hidden") && attributes.at("_hidden") == "1";
        node.children.push_back(take_int(content));
        take_int(content);  // reserved
        take_int(content);  // layer
        if (take_int(content) < 1) fault("a transform has no frame");
        const Dictionary frame = take_dictionary(content);
        if (frame.contains("_r")) node.rotation = rotation_of(frame.at("_r"));
        if (frame.contains("_t")) node.translation = translation_of(frame.at("_t"));
        add(id, std::move(node));
    }

    void read_group(Bytes content) {
        const std::int32_t id = take_int(content);
        take_dictionary(content);
        VoxFile::Node node;
        for (std::int32_t left = take_int(content); left > 0; --left)
            node.children.push_back(take_int(content));
        add(id, std::move(node));
    }

    void read_shape(Bytes content) {
        const std::int32_t id = take_int(content);
        take_dictionary(content);
        VoxFile::Node node;
        node.kind = VoxFile::Node::Kind::Shape;
        // Several models are frames of an animation: the first one is shown.
        if (take_int(content) < 1) fault("a shape has no model");
        node.children.push_back(take_int(content));
        take_dictionary(content);
        add(id, std::move(node));
    }

    void add(std::int32_t id, VoxFile::Node node) {
        if (!out_.nodes.emplace(id, std::move(node)).second) {
            fault("two nodes have the number " + std::to_string(id));
        }
    }

    /// Rows of a signed permutation: bits 0-1 and 2-3 say which entries of the first two rows are not 0, bits
    /// 4 to 6 which rows are negative.
    glm::imat3x3 rotation_of(const std::string& text) const {
        int bits = -1;
        std::istringstream(text) >> bits;
        const int first = bits & 3, second = bits >> 2 & 3;
        if (bits < 0 || bits > 127 || first == 3 || second == 3 || first == second) {
            fault("\"" + text + "\" is no rotation");
        }
        const std::array<int, 3> column = {first, second, 3 - first - second};
        glm::imat3x3 rotation(0);
        for (int row = 0; row < 3; ++row) {
            rotation[column[static_cast<std::size_t>(row)]][row] = (bits >> (4 + row) & 1) != 0 ? -1 : 1;
        }
        return rotation;
    }

    glm::ivec3 translation_of(const std::string& text) const {
        constexpr int farthest = 1 << 20;
        glm::ivec3 t(0);
        std::istringstream stream(text);
        if (!(stream >> t.x >> t.y >> t.z) || glm::any(glm::greaterThan(glm::abs(t), glm::ivec3(farthest)))) {
            fault("\"" + text + "\" is no translation");
        }
        return t;
    }

    void check_nodes() const {
        if (!out_.nodes.empty() && !out_.nodes.contains(0)) fault("its scene graph has no root");
        for (const auto& [id, node] : out_.nodes) {
            for (const std::int32_t child : node.children) {
                const bool found = node.kind == VoxFile::Node::Kind::Shape
                                       ? child >= 0 && static_cast<std::size_t>(child) < out_.models.size()
                                       : out_.nodes.contains(child);
                if (!found) fault("node " + std::to_string(id) + " names something that is not there");
            }
        }
    }

    /// 216 colours in steps of 0x33 from white, blue first, without black; then ten shades each of red,
    /// green, blue and grey.
    static std::array<vec3, 256> default_palette() {
        std::array<vec3, 256> palette{};
        const auto linear = [](int value) { return linear_from_srgb(static_cast<float>(value) / 255.0f); };
        for (int i = 0; i < 215; ++i) {
            palette[static_cast<std::size_t>(i) + 1] = {
                linear(255 - 51 * (i / 36)), linear(255 - 51 * (i / 6 % 6)), linear(255 - 51 * (i % 6))};
        }
        constexpr std::array<int, 10> shades = {0xEE, 0xDD, 0xBB, 0xAA, 0x88, 0x77, 0x55, 0x44, 0x22, 0x11};
        for (std::size_t i = 0; i < shades.size(); ++i) {
            const float shade = linear(shades[i]);
            palette[216 + i].r = shade;
            palette[226 + i].g = shade;
            palette[236 + i].b = shade;
            palette[246 + i] = vec3(shade);
        }
        return palette;
    }

    std::string file_;
    VoxFile out_;
    bool pending_size_ = false;  // a SIZE chunk waits for its XYZI
};

}  // namespace

VoxFile read_vox_chunks(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    if (!stream || std::filesystem::is_directory(file)) {
        throw_bad_input(file.string(), "it cannot be read", "correct the path");
    }
    const std::vector<char> bytes((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
    return VoxReader(file).read({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
}

}  // namespace foveray::scene
