#include "render/gpu/memory.h"

#include <numeric>

#include "base/error.h"
#include "render/gpu/compute_pipeline.h"
#include "render/gpu/texture_table.h"
#include "shaders/tests/gpu/sample.h"
#include "tests/fakes/gpu_fixture.h"

namespace foveray::gpu {
namespace {

class MemoryTest : public fakes::GpuTest {
  protected:
    static std::vector<glm::vec4> sample(const TextureTable& textures,
                                         const std::vector<shared::SampleUse>& uses) {
        const ComputePipeline pipeline(device(), "tests/gpu/sample.comp", textures,
                                       sizeof(shared::SamplePush));
        Uploader uploader(device());
        const Buffer input = uploader.buffer("uses", range_bytes(uses));
        uploader.flush();
        const Buffer output(device(), "colors", uses.size() * sizeof(glm::vec4), Residence::Device);
        const auto count = static_cast<std::uint32_t>(uses.size());
        submit_and_wait(device(), [&](const Commands& cmd) {
            pipeline.dispatch(cmd, shared::SamplePush{input.address(), output.address(), count, 0},
                              {count, 1, 1}, {4, 1, 1});
        });
        return read_back<glm::vec4>(output, count);
    }
};

TEST_F(MemoryTest, UploadedBytesComeBack) {
    std::vector<std::uint32_t> data(100'003);
    std::iota(data.begin(), data.end(), 7u);
    Uploader uploader(device());
    const Buffer large = uploader.buffer("large", range_bytes(data));
    const Buffer small = uploader.buffer("small", range_bytes(std::vector<std::uint32_t>{1, 2, 3}));
    const Buffer empty = uploader.buffer("empty", {});
    uploader.flush();
    EXPECT_EQ(read_back<std::uint32_t>(large, data.size()), data);
    EXPECT_EQ(read_back<std::uint32_t>(small, 3), (std::vector<std::uint32_t>{1, 2, 3}));
    EXPECT_NE(empty.address(), 0u);
    EXPECT_EQ(large.address() % 256, 0u);
}

TEST_F(MemoryTest, WritesAtAnOffset) {
    Buffer buffer(device(), "upload", 16, Residence::Upload);
    buffer.write(range_bytes(std::vector<std::uint32_t>{1, 2, 3, 4}));
    buffer.write(range_bytes(std::vector<std::uint32_t>{9}), 8);
    EXPECT_EQ(read_back<std::uint32_t>(buffer, 4), (std::vector<std::uint32_t>{1, 2, 9, 4}));
}

TEST_F(MemoryTest, MovingKeepsOneOwner) {
    const auto before = used_memory(device());
    {
        Buffer a(device(), "a", 1 << 20, Residence::Device);
        const auto address = a.address();
        Buffer b = std::move(a);
        EXPECT_FALSE(a);
        EXPECT_EQ(b.address(), address);
        EXPECT_GE(used_memory(device()), before + (1 << 20));
        b = Buffer(device(), "c", 16, Residence::Device);
    }
    EXPECT_EQ(used_memory(device()), before);
}

TEST_F(MemoryTest, GivenLevelsAreKeptAndTheRestHalved) {
    // 4 x 2, 2 x 1 and 1 x 1 texels: red tells the level.
    const auto red = [](std::size_t texels, std::uint8_t value) {
        std::vector<std::uint8_t> level;
        for (std::size_t i = 0; i < texels; ++i) level.insert(level.end(), {value, 0, 0, 255});
        return level;
    };
    std::vector<std::uint8_t> two = red(8, 10);
    std::ranges::copy(red(2, 90), std::back_inserter(two));
    std::vector<std::uint8_t> three = two;
    std::ranges::copy(red(1, 200), std::back_inserter(three));
    const ImageInfo info{.extent = {4, 2}, .mip_levels = 3, .usage = vk::ImageUsageFlagBits::eSampled};
    Uploader uploader(device());
    const Image all = uploader.image("all given", info, range_bytes(three), 3);
    const Image rest = uploader.image("two given", info, range_bytes(two), 2);
    uploader.flush();
    TextureTable textures(device());
    const std::uint32_t a = textures.add(all.view(), {}), r = textures.add(rest.view(), {});
    const auto colors = sample(textures, {{a, 0.5f, 0.5f, 0.0f},
                                          {a, 0.5f, 0.5f, 1.0f},
                                          {a, 0.5f, 0.5f, 2.0f},
                                          {r, 0.5f, 0.5f, 0.0f},
                                          {r, 0.5f, 0.5f, 1.0f},
                                          {r, 0.5f, 0.5f, 2.0f}});
    const float expected[] = {10, 90, 200, 10, 90, 90};
    for (std::size_t i = 0; i < colors.size(); ++i)
        EXPECT_NEAR(colors[i].r * 255.0f, expected[i], 1.01f) << i;
}

TEST_F(MemoryTest, MipsAreAveragesAndSamplersHold) {
    // 4 x 2 texels: red is the column, green the row.
    std::vector<std::uint8_t> texels;
    for (int y = 0; y < 2; ++y) {
        for (int x = 0; x < 4; ++x) {
            texels.insert(texels.end(),
                          {static_cast<std::uint8_t>(x * 60), static_cast<std::uint8_t>(y * 200), 30, 255});
        }
    }
    Uploader uploader(device());
    const Image image = uploader.image(
        "columns", {.extent = {4, 2}, .mip_levels = 3, .usage = vk::ImageUsageFlagBits::eSampled},
        range_bytes(texels));
    uploader.flush();
    TextureTable textures(device());
    const SamplerInfo nearest{
        .mag = vk::Filter::eNearest, .min = vk::Filter::eNearest, .mip = vk::SamplerMipmapMode::eNearest};
    SamplerInfo clamped = nearest, linear = nearest, no_mips = nearest;
    clamped.u = clamped.v = vk::SamplerAddressMode::eClampToEdge;
    linear.mag = linear.min = vk::Filter::eLinear;
    no_mips.use_mips = false;
    const std::uint32_t repeat = textures.add(image.view(), nearest);
    const std::uint32_t clamp = textures.add(image.view(), clamped);
    const std::uint32_t smooth = textures.add(image.view(), linear);
    const std::uint32_t flat = textures.add(image.view(), no_mips);
    EXPECT_EQ(flat, repeat + 3);

    const auto colors = sample(textures, {{repeat, 0.125f, 0.25f, 0.0f},
                                          {repeat, 0.875f, 0.75f, 0.0f},
                                          {repeat, 1.375f, 0.25f, 0.0f},  // wraps to column 1
                                          {clamp, 1.375f, -3.0f, 0.0f},   // stays at column 3, row 0
                                          {smooth, 0.25f, 0.25f, 0.0f},   // half way between columns 0 and 1
                                          {repeat, 0.25f, 0.5f, 1.0f},    // level 1: average of four
                                          {repeat, 0.5f, 0.5f, 2.0f},     // level 2: average of all
                                          {flat, 0.875f, 0.75f, 2.0f}});  // no levels
    const std::vector<glm::vec2> expected = {{0, 0},  {180, 200}, {60, 0},   {180, 0},
                                             {30, 0}, {30, 100},  {90, 100}, {180, 200}};
    for (std::size_t i = 0; i < expected.size(); ++i) {
        EXPECT_NEAR(colors[i].r * 255.0f, expected[i].x, 1.01f) << i;
        EXPECT_NEAR(colors[i].g * 255.0f, expected[i].y, 1.01f) << i;
        EXPECT_NEAR(colors[i].b * 255.0f, 30.0f, 1.01f) << i;
    }
}

TEST_F(MemoryTest, TextureIndicesAreReused) {
    Uploader uploader(device());
    const ImageInfo info{.extent = {1, 1}, .usage = vk::ImageUsageFlagBits::eSampled};
    const Image black = uploader.image("black", info, range_bytes(std::vector<std::uint8_t>{0, 0, 0, 255}));
    const Image white =
        uploader.image("white", info, range_bytes(std::vector<std::uint8_t>{255, 255, 255, 255}));
    uploader.flush();
    TextureTable textures(device());
    const std::uint32_t first = textures.add(black.view(), {}), second = textures.add(black.view(), {});
    textures.replace(second, white.view(), {});
    textures.remove(first);
    EXPECT_EQ(textures.add(white.view(), {}), first);
    const auto colors = sample(textures, {{first, 0.5f, 0.5f, 0.0f}, {second, 0.5f, 0.5f, 0.0f}});
    EXPECT_EQ(colors[0].r, 1.0f);
    EXPECT_EQ(colors[1].r, 1.0f);
    while (textures.add(white.view(), {}) + 1 < TextureTable::capacity) {
    }
    EXPECT_THROW(textures.add(white.view(), {}), Fault);
    EXPECT_THROW(textures.add(white.view(), {}), Fault);
}

}  // namespace
}  // namespace foveray::gpu
