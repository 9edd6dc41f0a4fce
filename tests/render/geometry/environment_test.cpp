#include <cmath>

#include <glm/gtc/packing.hpp>

#include "render/environment_light.h"
#include "tests/fakes/gpu_fixture.h"
#include "tests/render/geometry/comparison.h"

namespace foveray::render {
namespace {

using EnvironmentTest = fakes::GpuTest;

FloatImage picture_of(std::uint32_t width, std::uint32_t height, auto radiance) {
    FloatImage image(width, height, 3);
    for (std::uint32_t y = 0; y < height; ++y) {
        for (std::uint32_t x = 0; x < width; ++x) {
            const float azimuth =
                2 * pi * ((static_cast<float>(x) + 0.5f) / static_cast<float>(width) - 0.5f);
            const float polar = pi * (static_cast<float>(y) + 0.5f) / static_cast<float>(height);
            const vec3 value = radiance(vec3(std::sin(polar) * std::sin(azimuth), std::cos(polar),
                                             -std::sin(polar) * std::cos(azimuth)));
            std::copy_n(&value.x, 3, image.at(x, y));
        }
    }
    return image;
}

/// Ramamoorthi and Hanrahan 2001, eq. 5: E(n) from the coefficients.
vec3 irradiance(const std::array<vec3, 9>& c, vec3 n) {
    return 0.282095f * c[0] + 0.488603f * (n.y * c[1] + n.z * c[2] + n.x * c[3]) +
           1.092548f * (n.x * n.y * c[4] + n.y * n.z * c[5] + n.x * n.z * c[7]) +
           0.315392f * (3 * n.z * n.z - 1) * c[6] + 0.546274f * (n.x * n.x - n.y * n.y) * c[8];
}

const std::array directions = {vec3(1, 0, 0), vec3(0, -1, 0), vec3(0, 0, -1),
                               glm::normalize(vec3(1, -2, 0.5f))};

TEST(Irradiance, ofAConstantIsPiTimesIt) {
    for (const auto& image : {picture_of(1, 1, [](vec3) { return vec3(0.5f, 1, 2); }),
                              picture_of(64, 32, [](vec3) { return vec3(0.5f, 1, 2); })}) {
        for (const vec3 n : directions) {
            expect_near(irradiance(irradiance_coefficients(image), n), pi * vec3(0.5f, 1, 2), 5e-3f,
                        "irradiance");
        }
    }
}

TEST(Irradiance, ofLowOrderLightHasAClosedForm) {
    // L(w) = 1 + w·a + (w·b)² - 1/3 has bands 0, 1 and 2 only: E = pi + 2 pi/3 n·a + pi/4 ((n·b)² - 1/3).
    const vec3 a(0.3f, -0.5f, 0.2f), b = glm::normalize(vec3(1, 2, -1));
    const auto image = picture_of(256, 128, [&](vec3 w) {
        const float along = glm::dot(w, b);
        return vec3(1 + glm::dot(w, a), along * along - 1.0f / 3.0f, 0);
    });
    const auto coefficients = irradiance_coefficients(image);
    for (const vec3 n : directions) {
        const float along = glm::dot(n, b);
        expect_near(irradiance(coefficients, n),
                    {pi + 2 * pi / 3 * glm::dot(n, a), pi / 4 * (along * along - 1.0f / 3.0f), 0}, 5e-3f,
                    "irradiance");
    }
}

TEST_F(EnvironmentTest, aTexelIsAConstantWithoutATexture) {
    gpu::TextureTable table(device());
    scene::Environment environment = scene::constant_environment({1, 2, 3});
    environment.intensity = 4.0f;
    const EnvironmentLight light(device(), table, environment);
    EXPECT_EQ(light.shared().texture, shared::NO_TEXTURE);
    expect_near(light.shared().constant, {1, 2, 3}, 0.0f, "constant");
    EXPECT_EQ(light.shared().intensity, 4.0f);
}

TEST_F(EnvironmentTest, turnsThePictureAsTheSceneDoes) {
    gpu::TextureTable table(device());
    scene::Environment environment = scene::constant_environment(vec3(1));
    environment.rotation = 0.8f;
    const EnvironmentLight light(device(), table, environment);
    for (const vec3 d : directions) {
        const vec3 turned = light.shared().environment_from_world * d;
        const vec2 uv = scene::environment_uv(environment, d);
        if (std::abs(d.y) > 0.99f) continue;  // the azimuth means nothing at the poles
        const float u = 0.5f + std::atan2(turned.x, -turned.z) / (2 * pi);
        EXPECT_NEAR(std::remainder(u - uv.x, 1.0f), 0.0f, 1e-5f);
        EXPECT_NEAR(std::acos(turned.y) / pi, uv.y, 1e-5f);
    }
}

/// The texels of one level, RGB.
std::vector<vec3> read_level(const gpu::Device& device, const gpu::Image& image, std::uint32_t level) {
    const std::uint32_t width = image.info().extent.width >> level,
                        height = image.info().extent.height >> level;
    const gpu::Buffer readback(device, "test readback", 8 * width * height, gpu::Residence::Readback);
    gpu::submit_and_wait(device, [&](const gpu::Commands& cmd) {
        using gpu::Access;
        using Layout = vk::ImageLayout;
        gpu::transition(cmd.vk(), image.vk(), Access::RayTracingRead, Layout::eShaderReadOnlyOptimal,
                        Access::TransferRead, Layout::eTransferSrcOptimal);
        cmd->copyImageToBuffer(image.vk(), Layout::eTransferSrcOptimal, readback.vk(),
                               vk::BufferImageCopy(0, 0, 0, {vk::ImageAspectFlagBits::eColor, level, 0, 1},
                                                   {}, {width, height, 1}));
        gpu::transition(cmd.vk(), image.vk(), Access::TransferRead, Layout::eTransferSrcOptimal,
                        Access::RayTracingRead, Layout::eShaderReadOnlyOptimal);
        cmd.barrier(Access::TransferWrite, Access::HostRead);
    });
    readback.invalidate();
    std::vector<vec3> result;
    for (const std::uint64_t texel : readback.mapped_as<std::uint64_t>().first(std::size_t{width} * height)) {
        result.emplace_back(vec3(glm::unpackHalf4x16(texel)));
    }
    return result;
}

TEST_F(EnvironmentTest, levelsBlurFromTheMirrorToTheRough) {
    gpu::TextureTable table(device());
    scene::Environment environment;
    // Red: a constant. Green: the upper half of the sky. Blue: a small bright spot ahead.
    environment.radiance = picture_of(
        128, 64, [](vec3 w) { return vec3(0.7f, w.y > 0 ? 1.0f : 0.0f, -w.z > 0.98f ? 50.0f : 0.0f); });
    const EnvironmentLight light(device(), table, environment);
    ASSERT_EQ(light.shared().level_count, 4.0f);  // 64, 32, 16 and 8 rows
    float brightest = 50.0f;
    for (std::uint32_t level = 0; level < 4; ++level) {
        const auto texels = read_level(device(), light.image(), level);
        const std::uint32_t width = 128 >> level, height = 64 >> level;
        float peak = 0.0f;
        for (const vec3 texel : texels) {
            EXPECT_NEAR(texel.r, 0.7f, 2e-3f);
            peak = std::max(peak, texel.b);
        }
        const auto column = [&](std::uint32_t y) { return texels[y * width + width / 2].g; };
        EXPECT_GT(column(0), 0.9f);
        EXPECT_LT(column(height - 1), 0.1f);
        const float step = column(height / 2 - 1) - column(height / 2);
        if (level == 0) {
            EXPECT_EQ(step, 1.0f);
            EXPECT_EQ(peak, 50.0f);
        } else {
            EXPECT_LT(peak, brightest);
            EXPECT_LT(step, 0.5f);
            EXPECT_NEAR(column(height / 2 - 1) + column(height / 2), 1.0f, 0.05f);  // odd round the horizon
        }
        brightest = peak;
    }
    EXPECT_LT(brightest, 5.0f);
}

}  // namespace
}  // namespace foveray::render
