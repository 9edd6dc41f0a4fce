#include <gtest/gtest.h>

#include "base/error.h"
#include "passthrough/recorded_camera.h"

namespace foveray::passthrough {
namespace {

constexpr Nanoseconds ms = nanoseconds_per_millisecond;

/// Pictures of one pixel whose red is their index; counts how many were decoded.
class FakeReader : public PictureReader {
  public:
    FakeReader(std::vector<Nanoseconds> times, int& decoded) : times_(std::move(times)), decoded_(decoded) {}
    const std::string& name() const override { return name_; }
    uvec2 picture_size() const override { return {1, 1}; }
    Nanoseconds time_of(std::uint64_t index) const override { return times_[index]; }
    bool step() override { return next_ + 1 < times_.size() && ++next_; }
    Image picture() override {
        ++decoded_;
        Image image(1, 1, 4);
        image.pixels[0] = static_cast<std::uint8_t>(next_ - 1);
        return image;
    }
    void rewind() override { next_ = 0; }

  private:
    std::string name_ = "fake";
    std::vector<Nanoseconds> times_;
    std::size_t next_ = 0;
    int& decoded_;
};

class RecordedCameraTest : public testing::Test {
  protected:
    int decoded_ = 0;
    // Three pictures at 0, 10 and 25 ms; the recording is 40 ms long.
    RecordedCamera camera(Nanoseconds latency) {
        return {
            std::make_unique<FakeReader>(std::vector<Nanoseconds>{0, 10 * ms, 25 * ms, 40 * ms}, decoded_),
            latency};
    }
};

TEST_F(RecordedCameraTest, ShowsTheNewestPictureThatIsDue) {
    RecordedCamera c = camera(0);
    EXPECT_EQ(c.at(0)->capture_time, 0);
    EXPECT_EQ(c.at(9 * ms)->sequence, 0u);
    const CameraFramePtr second = c.at(10 * ms);
    EXPECT_EQ(second->capture_time, 10 * ms);
    EXPECT_EQ(second->sequence, 1u);
    EXPECT_EQ(second->picture.pixels[0], 1);
    EXPECT_EQ(second->source, "fake");
    EXPECT_EQ(c.at(24 * ms), second);
    EXPECT_EQ(c.at(25 * ms)->sequence, 2u);
}

TEST_F(RecordedCameraTest, LatencyDelaysTheArrivalButNotTheCaptureTime) {
    RecordedCamera c = camera(5 * ms);
    EXPECT_EQ(c.at(14 * ms)->sequence, 0u);
    EXPECT_EQ(c.at(15 * ms)->capture_time, 10 * ms);
}

TEST_F(RecordedCameraTest, ShowsTheFirstPictureBeforeItIsDue) {
    RecordedCamera c = camera(5 * ms);
    const CameraFramePtr first = c.at(0);
    ASSERT_TRUE(first);
    EXPECT_EQ(first->capture_time, 0);
    EXPECT_EQ(c.at(5 * ms), first);
}

TEST_F(RecordedCameraTest, StartsAgainAtTheEnd) {
    RecordedCamera c = camera(0);
    EXPECT_EQ(c.at(39 * ms)->sequence, 2u);
    const CameraFramePtr again = c.at(40 * ms);
    EXPECT_EQ(again->sequence, 3u);
    EXPECT_EQ(again->capture_time, 40 * ms);
    EXPECT_EQ(again->picture.pixels[0], 0);
    EXPECT_EQ(c.at(50 * ms)->picture.pixels[0], 1);
}

TEST_F(RecordedCameraTest, AnswersDependOnTheTimeAloneAndNotOnTheCallsBefore) {
    for (const Nanoseconds time : {12 * ms, 33 * ms, 47 * ms, 90 * ms, 1000 * ms}) {
        RecordedCamera often = camera(3 * ms), once = camera(3 * ms);
        for (Nanoseconds t = 0; t < time; t += ms) often.at(t);
        const CameraFramePtr a = often.at(time), b = once.at(time);
        EXPECT_EQ(a->sequence, b->sequence) << time;
        EXPECT_EQ(a->capture_time, b->capture_time) << time;
        EXPECT_EQ(a->picture, b->picture) << time;
    }
}

TEST_F(RecordedCameraTest, DecodesOnlyWhatIsShown) {
    RecordedCamera c = camera(0);
    c.at(0);
    c.at(3'600'000 * ms);
    EXPECT_EQ(decoded_, 2);
}

TEST_F(RecordedCameraTest, TimeThatGoesBackKeepsTheNewest) {
    RecordedCamera c = camera(0);
    c.at(25 * ms);
    EXPECT_EQ(c.at(3 * ms)->sequence, 2u);
}

TEST_F(RecordedCameraTest, RefusesARecordingWithoutPictures) {
    RecordedCamera c(std::make_unique<FakeReader>(std::vector<Nanoseconds>{0}, decoded_), 0);
    EXPECT_THROW(c.at(0), Fault);
}

TEST(NewestFrameTest, KeepsTheLastOne) {
    NewestFrame slot;
    EXPECT_EQ(slot.get(), nullptr);
    const auto first = std::make_shared<CameraFrame>(), second = std::make_shared<CameraFrame>();
    slot.push(first);
    slot.push(second);
    EXPECT_EQ(slot.get(), second);
    EXPECT_EQ(slot.get(), second);
}

}  // namespace
}  // namespace foveray::passthrough
