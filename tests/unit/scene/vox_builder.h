#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace foveray::scene {

/// Bytes of MagicaVoxel files.
class VoxBuilder {
  public:
    using Dictionary = std::vector<std::pair<std::string, std::string>>;
    using Voxel = std::array<int, 4>;  // x, y, z, colour

    static std::string word(std::int64_t value) {
        std::string bytes(4, '\0');
        for (std::size_t i = 0; i < 4; ++i) bytes[i] = static_cast<char>(value >> (8 * i) & 0xFF);
        return bytes;
    }
    static std::string text(const std::string& s) { return word(static_cast<std::int64_t>(s.size())) + s; }
    static std::string dictionary(const Dictionary& d) {
        std::string bytes = word(static_cast<std::int64_t>(d.size()));
        for (const auto& [key, value] : d) bytes += text(key) + text(value);
        return bytes;
    }

    VoxBuilder& chunk(const std::string& id, const std::string& content) {
        chunks_ += id + word(static_cast<std::int64_t>(content.size())) + word(0) + content;
        return *this;
    }
    VoxBuilder& model(int x, int y, int z, const std::vector<Voxel>& voxels) {
        std::string content = word(static_cast<std::int64_t>(voxels.size()));
        for (const Voxel& v : voxels) {
            for (const int value : v) content += static_cast<char>(value);
        }
        return chunk("SIZE", word(x) + word(y) + word(z)).chunk("XYZI", content);
    }
    VoxBuilder& transform(int id, int child, const Dictionary& frame, const Dictionary& attributes = {}) {
        return chunk("nTRN", word(id) + dictionary(attributes) + word(child) + word(-1) + word(0) + word(1) +
                                 dictionary(frame));
    }
    VoxBuilder& group(int id, const std::vector<int>& children) {
        std::string content = word(id) + dictionary({}) + word(static_cast<std::int64_t>(children.size()));
        for (const int child : children) content += word(child);
        return chunk("nGRP", content);
    }
    VoxBuilder& shape(int id, int model) {
        return chunk("nSHP", word(id) + dictionary({}) + word(1) + word(model) + dictionary({}));
    }

    std::string bytes() const {
        return "VOX " + word(150) + "MAIN" + word(0) + word(static_cast<std::int64_t>(chunks_.size())) +
               chunks_;
    }

  private:
    std::string chunks_;
};

}  // namespace foveray::scene
