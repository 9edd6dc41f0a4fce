#include "render/environment_light.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>

#include <glm/gtc/packing.hpp>

#include "render/gpu/compute_pipeline.h"
#include "shaders/shared/prefilter.h"

namespace foveray::render {
namespace {

constexpr float largest_half = 65504.0f;
constexpr std::uint32_t smallest_width = 64, smallest_height = 32;  // so that there are levels to blur
constexpr std::uint32_t coarsest_height = 8;
constexpr std::uint32_t samples_per_texel = 64;

std::array<float, 9> harmonics(vec3 n) {
    return {0.28209479f,
            0.48860251f * n.y,
            0.48860251f * n.z,
            0.48860251f * n.x,
            1.09254843f * n.x * n.y,
            1.09254843f * n.y * n.z,
            0.31539157f * (3.0f * n.z * n.z - 1.0f),
            1.09254843f * n.x * n.z,
            0.54627422f * (n.x * n.x - n.y * n.y)};
}

/// The picture as RGBA halves; a small one with each texel repeated until it is large enough.
struct HalfPicture {
    vk::Extent2D extent;
    std::vector<std::uint64_t> texels;
};

HalfPicture to_halves(const FloatImage& picture) {
    const std::uint32_t repeat_x = (smallest_width + picture.width - 1) / picture.width;
    const std::uint32_t repeat_y = (smallest_height + picture.height - 1) / picture.height;
    HalfPicture result{{picture.width * repeat_x, picture.height * repeat_y}, {}};
    result.texels.reserve(std::size_t{result.extent.width} * result.extent.height);
    for (std::uint32_t y = 0; y < result.extent.height; ++y) {
        for (std::uint32_t x = 0; x < result.extent.width; ++x) {
            const float* p = picture.at(x / repeat_x, y / repeat_y);
            const vec3 rgb = glm::clamp(vec3(p[0], p[1], p[2]), 0.0f, largest_half);
            result.texels.push_back(glm::packHalf4x16(vec4(rgb, 1.0f)));
        }
    }
    return result;
}

gpu::SamplerInfo panorama_sampler() {
    gpu::SamplerInfo sampler;
    sampler.v = vk::SamplerAddressMode::eClampToEdge;
    return sampler;
}

/// An entry of the table while this lives.
class Lent {
  public:
    Lent(gpu::TextureTable& table, vk::ImageView view)
        : table_(table), index_(table.add(view, panorama_sampler())) {}
    ~Lent() { table_.remove(index_); }
    Lent(const Lent&) = delete;
    Lent& operator=(const Lent&) = delete;
    std::uint32_t index() const { return index_; }

  private:
    gpu::TextureTable& table_;
    std::uint32_t index_;
};

vk::Extent2D level_extent(vk::Extent2D base, std::uint32_t level) {
    return {std::max(1u, base.width >> level), std::max(1u, base.height >> level)};
}

}  // namespace

std::array<vec3, 9> irradiance_coefficients(const FloatImage& radiance) {
    std::array<glm::dvec3, 9> sum{};
    for (std::uint32_t y = 0; y < radiance.height; ++y) {
        // Large texels are cut into parts; a part's solid angle is exact.
        const std::uint32_t parts_x = std::max(1u, 64 / radiance.width),
                            parts_y = std::max(1u, 32 / radiance.height);
        for (std::uint32_t part_y = 0; part_y < parts_y; ++part_y) {
            const float v =
                (static_cast<float>(y) + (static_cast<float>(part_y) + 0.5f) / static_cast<float>(parts_y));
            const float polar = pi * v / static_cast<float>(radiance.height);
            const double part = glm::pi<double>() / (radiance.height * parts_y);
            const double row = static_cast<double>(y * parts_y + part_y);
            const double weight = (std::cos(part * row) - std::cos(part * (row + 1.0))) * 2.0 *
                                  glm::pi<double>() / (radiance.width * parts_x);
            for (std::uint32_t x = 0; x < radiance.width; ++x) {
                const float* p = radiance.at(x, y);
                for (std::uint32_t part_x = 0; part_x < parts_x; ++part_x) {
                    const float u = static_cast<float>(x) +
                                    (static_cast<float>(part_x) + 0.5f) / static_cast<float>(parts_x);
                    const float azimuth = 2.0f * pi * (u / static_cast<float>(radiance.width) - 0.5f);
                    const vec3 n(std::sin(polar) * std::sin(azimuth), std::cos(polar),
                                 -std::sin(polar) * std::cos(azimuth));
                    const auto basis = harmonics(n);
                    for (int i = 0; i < 9; ++i) {
                        sum[i] += glm::dvec3(p[0], p[1], p[2]) * (weight * static_cast<double>(basis[i]));
                    }
                }
            }
        }
    }
    constexpr std::array<double, 9> cosine = {3.14159265, 2.09439510, 2.09439510, 2.09439510, 0.78539816,
                                              0.78539816, 0.78539816, 0.78539816, 0.78539816};
    std::array<vec3, 9> result;
    for (int i = 0; i < 9; ++i) result[i] = vec3(sum[i] * cosine[i]);
    return result;
}

EnvironmentLight::EnvironmentLight(const gpu::Device& device, gpu::TextureTable& table,
                                   const scene::Environment& environment)
    : table_(table) {
    const FloatImage& picture = environment.radiance;
    // Turning the picture counter-clockwise from above turns directions the other way.
    shared_.environment_from_world =
        mat3(glm::rotate(mat4(1.0f), -environment.rotation, vec3(0.0f, 1.0f, 0.0f)));
    shared_.intensity = environment.intensity;
    shared_.texture = shared::NO_TEXTURE;
    const auto irradiance = irradiance_coefficients(picture);
    std::copy(irradiance.begin(), irradiance.end(), shared_.irradiance_sh);
    if (picture.width == 1 && picture.height == 1) {
        shared_.constant = vec3(picture.pixels[0], picture.pixels[1], picture.pixels[2]);
        return;
    }
    prefilter(device, environment);
}

EnvironmentLight::~EnvironmentLight() {
    if (shared_.texture != shared::NO_TEXTURE) table_.remove(shared_.texture);
}

void EnvironmentLight::prefilter(const gpu::Device& device, const scene::Environment& environment) {
    const HalfPicture picture = to_halves(environment.radiance);
    const std::uint32_t all_levels =
        static_cast<std::uint32_t>(std::bit_width(std::max(picture.extent.width, picture.extent.height)));
    const std::uint32_t levels =
        static_cast<std::uint32_t>(std::bit_width(picture.extent.height / coarsest_height));

    gpu::ImageInfo info{picture.extent, vk::Format::eR16G16B16A16Sfloat, all_levels,
                        vk::ImageUsageFlagBits::eSampled};
    gpu::Uploader uploader(device);
    const gpu::Image source = uploader.image("environment source", info, gpu::range_bytes(picture.texels));
    uploader.flush();
    std::optional<Lent> lent(std::in_place, table_, source.view());

    std::vector<vk::DeviceSize> offsets;
    vk::DeviceSize size = 0;
    for (std::uint32_t level = 1; level < levels; ++level) {
        const vk::Extent2D extent = level_extent(picture.extent, level);
        offsets.push_back(size);
        size += vk::DeviceSize{8} * extent.width * extent.height;
    }
    const gpu::Buffer texels(device, "environment levels", size, gpu::Residence::Device);
    info.mip_levels = levels;
    info.usage = vk::ImageUsageFlagBits::eSampled | vk::ImageUsageFlagBits::eTransferSrc |
                 vk::ImageUsageFlagBits::eTransferDst;
    image_ = gpu::Image(device, "environment", info);
    const gpu::ComputePipeline pipeline(device, "render/prefilter.comp", table_,
                                        sizeof(shared::PrefilterPush));

    gpu::submit_and_wait(device, [&](const gpu::Commands& cmd) {
        using Layout = vk::ImageLayout;
        using gpu::Access;
        for (std::uint32_t level = 1; level < levels; ++level) {
            const vk::Extent2D extent = level_extent(picture.extent, level);
            const float roughness = static_cast<float>(level) / static_cast<float>(levels - 1);
            const shared::PrefilterPush push{texels.address() + offsets[level - 1],
                                             {extent.width, extent.height},
                                             lent->index(),
                                             roughness,
                                             samples_per_texel};
            pipeline.dispatch(cmd, push, {extent.width, extent.height, 1}, {8, 8, 1});
        }
        cmd.barrier(Access::ComputeWrite, Access::TransferRead);
        gpu::transition(cmd.vk(), source.vk(), Access::ComputeRead, Layout::eShaderReadOnlyOptimal,
                        Access::TransferRead, Layout::eTransferSrcOptimal);
        gpu::transition(cmd.vk(), image_.vk(), Access::None, Layout::eUndefined, Access::TransferWrite,
                        Layout::eTransferDstOptimal);
        constexpr auto colour = vk::ImageAspectFlagBits::eColor;
        const vk::Extent3D whole(picture.extent.width, picture.extent.height, 1);
        cmd->copyImage(source.vk(), Layout::eTransferSrcOptimal, image_.vk(), Layout::eTransferDstOptimal,
                       vk::ImageCopy({colour, 0, 0, 1}, {}, {colour, 0, 0, 1}, {}, whole));
        for (std::uint32_t level = 1; level < levels; ++level) {
            const vk::Extent2D extent = level_extent(picture.extent, level);
            cmd->copyBufferToImage(texels.vk(), image_.vk(), Layout::eTransferDstOptimal,
                                   vk::BufferImageCopy(offsets[level - 1], 0, 0, {colour, level, 0, 1}, {},
                                                       {extent.width, extent.height, 1}));
        }
        gpu::transition(cmd.vk(), image_.vk(), Access::TransferWrite, Layout::eTransferDstOptimal,
                        Access::RayTracingRead, Layout::eShaderReadOnlyOptimal);
    });
    lent.reset();
    shared_.texture = table_.add(image_.view(), panorama_sampler());
    shared_.level_count = static_cast<float>(levels);
}

}  // namespace foveray::render
