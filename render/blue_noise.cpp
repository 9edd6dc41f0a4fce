#include "render/blue_noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace foveray::render {
namespace {

constexpr int reach = 9;         // cells, beyond which a point's energy is negligible
constexpr float sigma = 1.9f;    // cells: Ulichney's 1.5 to 2
constexpr int first_share = 10;  // of so many cells one is set before ranks are given

/// Points on a torus and the energy that they give each cell.
class Pattern {
  public:
    explicit Pattern(int size) : size_(size), set_(cells()), energy_(cells()) {
        for (int y = -reach; y <= reach; ++y) {
            for (int x = -reach; x <= reach; ++x)
                kernel_[at(y)][at(x)] = std::exp(-static_cast<float>(x * x + y * y) / (2.0f * sigma * sigma));
        }
    }

    std::size_t cells() const { return static_cast<std::size_t>(size_) * static_cast<std::size_t>(size_); }
    bool is_set(std::size_t cell) const { return set_[cell]; }

    void put(std::size_t cell, bool value) {
        set_[cell] = value;
        const int column = static_cast<int>(cell) % size_, row = static_cast<int>(cell) / size_;
        for (int y = -reach; y <= reach; ++y) {
            for (int x = -reach; x <= reach; ++x) {
                float& energy = energy_[index(column + x, row + y)];
                energy += value ? kernel_[at(y)][at(x)] : -kernel_[at(y)][at(x)];
            }
        }
    }

    std::size_t tightest_cluster() const {
        return extreme(true, [](float a, float b) { return a > b; });
    }
    std::size_t largest_void() const {
        return extreme(false, [](float a, float b) { return a < b; });
    }

  private:
    static std::size_t at(int offset) { return static_cast<std::size_t>(offset + reach); }
    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>((y + size_) % size_ * size_ + (x + size_) % size_);
    }
    template <typename Better>
    std::size_t extreme(bool among_set, Better better) const {
        std::size_t best = cells();
        for (std::size_t i = 0; i < cells(); ++i) {
            if (set_[i] == among_set && (best == cells() || better(energy_[i], energy_[best]))) best = i;
        }
        return best;
    }

    int size_;
    std::vector<bool> set_;
    std::vector<float> energy_;
    std::array<std::array<float, 2 * reach + 1>, 2 * reach + 1> kernel_{};
};

/// A pattern without clusters or voids, from cells chosen by `seed`.
Pattern first_pattern(int size, std::uint32_t seed) {
    Pattern pattern(size);
    for (std::size_t i = 0; i < pattern.cells() / first_share; ++i) {
        std::size_t cell = 0;
        do {
            seed = seed * 1664525u + 1013904223u;
            cell = (seed >> 8) % pattern.cells();
        } while (pattern.is_set(cell));
        pattern.put(cell, true);
    }
    for (;;) {
        const std::size_t cluster = pattern.tightest_cluster();
        pattern.put(cluster, false);
        const std::size_t hole = pattern.largest_void();
        pattern.put(hole, true);
        if (hole == cluster) return pattern;
    }
}

/// The order in which cells are set, such that the set ones are evenly spread at every time.
std::vector<std::uint32_t> ranks(int size, std::uint32_t seed) {
    const Pattern first = first_pattern(size, seed);
    std::vector<std::uint32_t> rank(first.cells());
    const std::size_t count = first.cells() / first_share;
    Pattern shrinking = first;
    for (std::size_t i = count; i-- > 0;) {
        const std::size_t cell = shrinking.tightest_cluster();
        shrinking.put(cell, false);
        rank[cell] = static_cast<std::uint32_t>(i);
    }
    Pattern growing = first;
    for (std::size_t i = count; i < rank.size(); ++i) {
        const std::size_t cell = growing.largest_void();
        growing.put(cell, true);
        rank[cell] = static_cast<std::uint32_t>(i);
    }
    return rank;
}

}  // namespace

std::vector<std::uint32_t> make_blue_noise(std::uint32_t size) {
    const auto side = static_cast<int>(size);
    const std::vector<std::uint32_t> low = ranks(side, 1), high = ranks(side, 2);
    std::vector<std::uint32_t> pairs(low.size());
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        const auto fraction = [&](std::uint32_t rank) {
            return static_cast<std::uint32_t>((std::uint64_t{rank} * 65536 + 32768) / pairs.size());
        };
        pairs[i] = fraction(low[i]) | fraction(high[i]) << 16;
    }
    return pairs;
}

}  // namespace foveray::render
