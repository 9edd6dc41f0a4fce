#pragma once

#include <array>

#include "render/gpu/commands.h"
#include "render/gpu/texture_table.h"
#include "render/scene/light.h"
#include "shaders/shared/scene.h"

namespace foveray::render {

/// Irradiance of a latitude-longitude picture in its own frame as nine coefficients, cosine lobe included:
/// E(n) is the sum of coefficient i times the real spherical harmonic Y_i(n), in the order 1; y, z, x; xy,
/// yz, 3z²-1, xz, x²-y² (Ramamoorthi and Hanrahan 2001, eq. 4, 9 and 10). Without Environment::intensity.
std::array<vec3, 9> irradiance_coefficients(const FloatImage& radiance);

/// An environment on the GPU: the picture with its levels blurred for roughness 0 … 1, and its irradiance. A
/// picture of one texel is a constant and takes no texture. Works on the device at once, outside any frame.
class EnvironmentLight {
  public:
    EnvironmentLight(const gpu::Device& device, gpu::TextureTable& table,
                     const scene::Environment& environment);
    ~EnvironmentLight();
    EnvironmentLight(const EnvironmentLight&) = delete;
    EnvironmentLight& operator=(const EnvironmentLight&) = delete;

    const shared::Environment& shared() const { return shared_; }
    /// RGBA16F, level i blurred for roughness i / (level_count - 1); empty for a constant.
    const gpu::Image& image() const { return image_; }

  private:
    void prefilter(const gpu::Device& device, const scene::Environment& environment);

    gpu::TextureTable& table_;
    gpu::Image image_;
    shared::Environment shared_{};
};

}  // namespace foveray::render
