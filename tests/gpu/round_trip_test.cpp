#include "shaders/tests/gpu/round_trip.h"

#include <cstring>
#include <vector>

#include "render/gpu/compute_pipeline.h"
#include "struct_fields.h"
#include "tests/fakes/gpu_fixture.h"

namespace foveray::gpu {
namespace {

using namespace shared;

constexpr std::uint32_t element_count = 3;  // shows the array stride too

/// Collects a struct's fields as words, in order.
struct Read {
    std::vector<std::uint32_t> words;

    template <typename T>
    void operator()(const T& value) {
        static_assert(sizeof(T) % 4 == 0);
        std::uint32_t parts[sizeof(T) / 4];
        std::memcpy(parts, &value, sizeof(T));
        for (const std::uint32_t part : parts) words.push_back(part);
    }
};

/// Gives every component a value of its own: small whole numbers that floats hold.
struct Fill {
    std::uint32_t next = 1;

    void operator()(float& value) { value = static_cast<float>(next++); }
    void operator()(std::uint32_t& value) { value = next++; }
    void operator()(std::uint64_t& value) {
        value = (std::uint64_t{next} << 32) | (next + 1);
        next += 2;
    }
    template <glm::length_t n, typename T>
    void operator()(glm::vec<n, T>& value) {
        for (glm::length_t i = 0; i < n; ++i) (*this)(value[i]);
    }
    template <glm::length_t columns, glm::length_t rows>
    void operator()(glm::mat<columns, rows, float>& value) {
        for (glm::length_t i = 0; i < columns; ++i) (*this)(value[i]);
    }
};

class RoundTripTest : public fakes::GpuTest {
  protected:
    template <typename Struct>
    void check(const char* name, std::uint32_t number) {
        SCOPED_TRACE(name);
        std::vector<Struct> structs(element_count, Struct{});
        Fill fill;
        Read read;
        for (Struct& s : structs) {
            fields(fill, s);
            fields(read, s);
        }
        const std::vector<std::uint32_t>& words = read.words;
        const auto words_per_struct = static_cast<std::uint32_t>(words.size()) / element_count;
        ASSERT_LT(sizeof(Struct) - 4 * words_per_struct, 8u) << "fields that no visitor sees";

        Uploader uploader(device());
        const Buffer struct_input = uploader.buffer("structs in", range_bytes(structs));
        const Buffer word_input = uploader.buffer("words in", range_bytes(words));
        uploader.flush();
        const Buffer struct_output(device(), "structs out", sizeof(Struct) * element_count,
                                   Residence::Device);
        const Buffer word_output(device(), "words out", 4 * words.size(), Residence::Device);
        submit_and_wait(device(), [&](const Commands& cmd) {
            pipeline_.dispatch(
                cmd,
                RoundTripPush{struct_input.address(), word_output.address(), number, words_per_struct, 0, 0},
                {element_count, 1, 1}, {1, 1, 1});
            pipeline_.dispatch(
                cmd,
                RoundTripPush{struct_output.address(), word_input.address(), number, words_per_struct, 1, 0},
                {element_count, 1, 1}, {1, 1, 1});
        });
        EXPECT_EQ(read_back<std::uint32_t>(word_output, words.size()), words) << "C++ to GLSL";
        Read back;
        for (Struct& s : read_back<Struct>(struct_output, element_count)) fields(back, s);
        EXPECT_EQ(back.words, words) << "GLSL to C++";
    }

  private:
    TextureTable textures_{device()};
    ComputePipeline pipeline_{device(), "tests/gpu/round_trip.comp", textures_, sizeof(RoundTripPush)};
};

TEST_F(RoundTripTest, EverySharedStructMeansTheSameToBothLanguages) {
#define CHECK_STRUCT(Struct, number) check<Struct>(#Struct, number);
    FOR_EACH_SHARED_STRUCT(CHECK_STRUCT)
}

}  // namespace
}  // namespace foveray::gpu
