#include "app/bench/run_bench.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <chrono>
#include <cmath>
#include <iostream>

#include <spdlog/fmt/fmt.h>

#include "app/program.h"
#include "render/user_shapes/shape_store.h"

namespace foveray::app {
namespace {

constexpr int warm_up_frames = 5;

struct Result {
    std::string name;
    std::vector<std::pair<std::string, Spread>> stages;
    Spread gpu_ms, cpu_ms, bare_ms;
    std::size_t frames = 0;
    render::RayCounts rays{};
    std::uint64_t memory_bytes = 0;
};

double total_of(const ShotCost& cost) {
    double sum = 0.0;
    for (const gpu::StageTime& stage : cost.stages) sum += stage.milliseconds;
    return sum;
}

Shot smaller(Shot shot) {
    for (View& view : shot.views) view.size = glm::max(view.size / 4u, uvec2(1));
    shot.settings.resolution_scale *= 0.25f;
    return shot;
}

std::vector<ShotCost> measure(Offscreen& offscreen, Shot shot, double frame_ms, const BenchOptions& options) {
    std::vector<ShotCost> costs;
    const auto start = std::chrono::steady_clock::now();
    const auto enough = [&](int frame) {
        if (options.quick) return frame >= 3;
        const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
        return frame >= warm_up_frames + 3 && elapsed.count() > options.seconds;
    };
    for (int frame = 0; !enough(frame); ++frame) {
        shot.time = static_cast<Nanoseconds>(frame * frame_ms * 1e6);
        if (auto cost = offscreen.draw(shot)) costs.push_back(std::move(*cost));
    }
    for (ShotCost& cost : offscreen.finish()) costs.push_back(std::move(cost));
    const std::size_t skipped =
        options.quick ? 1 : warm_up_frames;  // a driver may still compile in the first
    costs.erase(costs.begin(), costs.begin() + static_cast<std::ptrdiff_t>(skipped));
    return costs;
}

/// The frame's rays alone. Empty when they are too many to be kept.
Spread measure_bare(Offscreen& offscreen, Shot shot, int frames) {
    offscreen.draw(shot);
    std::uint64_t rays = 0;
    for (const std::uint64_t kind : offscreen.finish().back().rays) rays += kind;
    constexpr std::uint64_t most = 80'000'000;  // 3 GB
    if (rays > most) return {};
    shot.bare_rays = static_cast<std::uint32_t>(rays + rays / 16 + 64);  // frames differ by a few
    std::vector<double> times;
    const auto add = [&](const ShotCost& cost) {
        for (const gpu::StageTime& stage : cost.stages) {
            if (stage.name == "bare") times.push_back(stage.milliseconds);
        }
    };
    for (int frame = 0; frame < frames; ++frame) {
        if (const auto cost = offscreen.draw(shot)) add(*cost);
    }
    for (const ShotCost& cost : offscreen.finish()) add(cost);
    return spread_of(std::move(times));
}

Result summarize(const BenchRow& row, const std::vector<ShotCost>& costs, std::uint64_t memory) {
    const auto spread = [&](const auto& value) {
        std::vector<double> values;
        for (const ShotCost& cost : costs) values.push_back(value(cost));
        return spread_of(std::move(values));
    };
    Result result;
    result.name = row.name;
    result.frames = costs.size();
    result.gpu_ms = spread(total_of);
    result.cpu_ms = spread([](const ShotCost& c) { return c.cpu_ms; });
    result.rays = costs.back().rays;
    result.memory_bytes = memory;
    for (std::size_t i = 0; i < costs.front().stages.size(); ++i) {
        result.stages.emplace_back(costs.front().stages[i].name,
                                   spread([&](const ShotCost& c) { return c.stages[i].milliseconds; }));
    }
    return result;
}

/// Letters, digits and single hyphens.
std::string file_name(const std::string& row) {
    std::string name;
    for (const char c : row) {
        if (std::isalnum(static_cast<unsigned char>(c)) || c == '_') {
            name += c;
        } else if (!name.empty() && name.back() != '-' && c != '\'') {
            name += '-';
        }
    }
    return name;
}

Result run_row(const gpu::Device& device, user_shapes::ShapeStore& shapes, const BenchRow& row,
               const BenchOptions& options) {
    const scene::Scene scene = row.scene();
    Shot shot = row.shot(scene);
    for (const std::string& assignment : options.assignments) set(shot.settings, assignment);
    if (options.quick) shot = smaller(std::move(shot));
    const std::uint64_t before = gpu::used_memory(device);
    Offscreen offscreen(device, scene, 2, shapes.prepare(scene));
    const std::vector<ShotCost> costs = measure(offscreen, shot, row.frame_ms, options);
    const std::uint64_t memory = gpu::used_memory(device) - before;
    const Spread bare = measure_bare(offscreen, shot, options.quick ? 1 : 10);
    if (!options.out.empty()) {
        for (std::size_t view = 0; view < shot.views.size(); ++view) {
            write_png(options.out / fmt::format("{}_view{}.png", file_name(row.name), view),
                      offscreen.picture(view));
        }
    }
    Result result = summarize(row, costs, memory);
    result.bare_ms = bare;
    return result;
}

Json to_json(const Spread& spread) { return {{"median", spread.median}, {"p99", spread.p99}}; }

Json to_json(const Result& r) {
    Json stages = Json::object();
    for (const auto& [name, time] : r.stages) stages[name] = to_json(time);
    return {{"row", r.name},
            {"gpu_ms", to_json(r.gpu_ms)},
            {"cpu_ms", to_json(r.cpu_ms)},
            {"bare_ms", to_json(r.bare_ms)},
            {"stages_ms", stages},
            {"frames", r.frames},
            {"memory_bytes", r.memory_bytes},
            {"rays",
             {{"primary", r.rays[shared::COUNT_PRIMARY]},
              {"shadow", r.rays[shared::COUNT_SHADOW]},
              {"reflection", r.rays[shared::COUNT_REFLECTION]},
              {"transparent", r.rays[shared::COUNT_TRANSPARENT]},
              {"probe", r.rays[shared::COUNT_PROBE]},
              {"occlusion", r.rays[shared::COUNT_OCCLUSION]}}}};
}

/// Stages with a column of their own; the rest is "other".
constexpr std::array columns = {"probes", "primary", "shadows", "lighting", "history", "resolve"};

void print_header() {
    std::cout << "| row | GPU ms | 99 % |";
    for (const char* name : columns) std::cout << ' ' << name << " |";
    std::cout << " other | Mrays | bare | CPU ms | MB |\n|";
    for (std::size_t i = 0; i < columns.size() + 8; ++i) std::cout << " --- |";
    std::cout << '\n';
}

void print(const Result& r) {
    std::cout << fmt::format("| {} | {:.2f} | {:.2f} |", r.name, r.gpu_ms.median, r.gpu_ms.p99);
    double other = 0.0;
    for (const auto& [name, time] : r.stages) other += time.median;
    for (const char* column : columns) {
        double sum = 0.0;
        for (const auto& [name, time] : r.stages) sum += name == column ? time.median : 0.0;
        std::cout << fmt::format(" {:.2f} |", sum);
        other -= sum;
    }
    std::uint64_t rays = 0;
    for (const std::uint64_t kind : r.rays) rays += kind;
    std::cout << fmt::format(" {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.0f} |\n", std::max(other, 0.0),
                             static_cast<double>(rays) * 1e-6, r.bare_ms.median, r.cpu_ms.median,
                             static_cast<double>(r.memory_bytes) / (1 << 20))
              << std::flush;
}

}  // namespace

Spread spread_of(std::vector<double> values) {
    if (values.empty()) return {};
    std::ranges::sort(values);
    const auto at = [&](double part) {
        return values[static_cast<std::size_t>(std::llround(part * static_cast<double>(values.size() - 1)))];
    };
    return {at(0.5), at(0.99)};
}

ExitCode run_bench(const BenchOptions& options) {
    gpu::DeviceOptions device_options;
    device_options.index = options.gpu;
    device_options.validation = validation_wanted();
    const gpu::Device device(device_options);
    if (!options.json) std::cout << device.name() << ", " << device.driver() << "\n\n";

    user_shapes::ShapeStore shapes({.gpu = options.gpu, .validation = validation_wanted()});
    Json tables = Json::array();
    for (const BenchTable& table : bench_tables()) {
        const auto& wanted = options.tables;
        if (!wanted.empty() && std::ranges::find(wanted, table.name) == wanted.end()) continue;
        Json rows = Json::array();
        if (!options.json) print_header();
        for (const BenchRow& row : table.rows()) {
            if (row.name.find(options.rows) == std::string::npos) continue;
            const Result result = run_row(device, shapes, row, options);
            if (!options.json) print(result);
            rows.push_back(to_json(result));
        }
        tables.push_back({{"table", table.name}, {"rows", rows}});
    }
    const Json report = {{"device", device.name()}, {"driver", device.driver()}, {"tables", tables}};
    if (options.json) std::cout << report.dump(2) << '\n';
    if (!options.out.empty()) {
        std::filesystem::create_directories(options.out);
        write_json(options.out / "bench.json", report);
    }
    return device.validation_messages().empty() ? ExitCode::Done : ExitCode::Internal;
}

}  // namespace foveray::app
