#include "xr/simulator/timing_file.h"

#include <chrono>
#include <iomanip>
#include <set>
#include <utility>

#include "base/error.h"
#include "xr/simulator/api/call_cost.h"
#include "xr/simulator/api/verify.h"

namespace foveray::simulator {
namespace {

/// The first instance of a process begins a file anew.
bool begins(const std::filesystem::path& file) {
    static std::mutex mutex;
    static std::set<std::filesystem::path> begun;
    const std::lock_guard lock(mutex);
    return begun.insert(std::filesystem::absolute(file)).second;
}

}  // namespace

TimingFile::TimingFile(const std::filesystem::path& file) : file_(file) {
    const bool is_new = begins(file);
    out_.open(file, is_new ? std::ios::trunc : std::ios::app);
    if (is_new) {
        out_ << "frame,session_time_ns,predicted_display_ns,wait_called_ns,wait_returned_ns,begin_ns,end_"
                "called_ns,"
                "end_returned_ns,missed_frames,layers,simulator_cpu_us,composition_gpu_ms"
             << std::endl;
    }
    if (!out_) {
        throw_bad_input("FOVERAY_SIMULATOR_TIMING=" + file.string(), "cannot be written",
                        "name a file in a folder that exists");
    }
    ++call_cost::measurers;
}

TimingFile::~TimingFile() { --call_cost::measurers; }

Nanoseconds TimingFile::now() {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(
               std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

void TimingFile::waited(const FrameTime& frame, Nanoseconds session_time, Nanoseconds called) {
    const std::lock_guard lock(mutex_);
    rows_[frame.index] = {session_time, called, now(), 0};
}

void TimingFile::begun(const FrameTime& frame) {
    const std::lock_guard lock(mutex_);
    rows_[frame.index].begun = now();
}

void TimingFile::ended(const FrameTime& frame, const End& end) {
    const std::lock_guard lock(mutex_);
    const Row row = rows_[frame.index];
    rows_.erase(rows_.begin(), rows_.upper_bound(frame.index));  // the client gave earlier ones up
    const Nanoseconds cost = call_cost::take();
    out_ << frame.index << ',' << row.session_time << ',' << frame.display_time << ',' << row.wait_called
         << ',' << row.wait_returned << ',' << row.begun << ',' << end.called << ',' << now() << ','
         << end.missed_frames - missed_frames_ << ',' << end.layers << ',' << std::fixed
         << std::setprecision(1) << static_cast<double>(cost) * 1e-3 << ',';
    if (end.composition_ms) out_ << std::setprecision(4) << *end.composition_ms;
    out_ << std::endl;  // a client may crash in the next frame
    if (!out_ && !std::exchange(is_cut_short_, true))
        report(file_.string() + ": cannot be written any more; check the free space");
    missed_frames_ = end.missed_frames;
    call_cost::skip();
}

}  // namespace foveray::simulator
