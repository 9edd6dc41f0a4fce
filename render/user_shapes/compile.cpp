#include "render/user_shapes/compile.h"

#include <algorithm>
#include <array>
#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>
#include <glslang/SPIRV/spirv.hpp>
#include <mutex>
#include <optional>
#include <regex>
#include <span>
#include <sstream>
#include <string>

#include "base/error.h"
#include "render/user_shapes/snippets.h"

namespace foveray::user_shapes {
namespace {

constexpr const char* wrapper_name = "foveray";  // of what is written here, in glslang's messages

/// Finds foveray's own GLSL and the user's file.
class Includer : public glslang::TShader::Includer {
  public:
    explicit Includer(const scene::UserShapeCode& code) : code_(code), name_(code.file.string()) {}

    static constexpr const char* user_file = "the user's file";

    IncludeResult* includeLocal(const char* name, const char*, std::size_t depth) override {
        constexpr std::size_t deepest = 16;
        if (depth > deepest) return nullptr;
        if (std::string_view(name) == user_file && depth == 1) {
            return new IncludeResult(name_, code_.text.data(), code_.text.size(), nullptr);
        }
        for (const auto& [path, text] : snippets()) {
            if (path == name) return new IncludeResult(name, text.data(), text.size(), nullptr);
        }
        return nullptr;
    }
    IncludeResult* includeSystem(const char* name, const char* includer, std::size_t depth) override {
        return includeLocal(name, includer, depth);
    }
    void releaseInclude(IncludeResult* result) override { delete result; }

  private:
    const scene::UserShapeCode& code_;
    std::string name_;
};

/// glslang's first error, at its place in the user's file.
[[noreturn]] void throw_first_error(const scene::UserShapeCode& code, const std::string& log) {
    static const std::regex pattern(R"(ERROR: (.*?):(\d+): (.*))");
    std::istringstream lines(log);
    std::smatch match;
    std::string first;
    for (std::string line; std::getline(lines, line);) {
        if (first.empty() && line.starts_with("ERROR: ")) first = line.substr(7);
        if (std::regex_match(line, match, pattern) && match[1] == code.file.string()) {
            throw_bad_input(code.file.string() + ":" + match[2].str(), match[3].str(), "correct it");
        }
    }
    if (log.find("missing #endif") != std::string::npos) {
        throw_bad_input(code.file.string(), "an #if has no #endif", "end it with one");
    }
    if (log.find("ecursion detected") != std::string::npos) {
        throw_bad_input(code.file.string(), "a function calls itself: " + first, "write a loop instead");
    }
    throw_bad_input(code.file.string(), "does not fit into foveray's shader: " + first,
                    "rename what it defines besides distance_at, intersect and color_at");
}

struct Capability {
    spv::Capability number;
    const char* name;
};

/// What GLSL without extensions can ask of a GPU, and foveray does not.
constexpr Capability not_enabled[] = {
    {spv::CapabilityFloat64, "numbers of double precision"},
    {spv::CapabilityFloat16, "numbers of 16 bits"},
    {spv::CapabilityInt16, "integers of 16 bits"},
    {spv::CapabilityInt8, "integers of 8 bits"},
    {spv::CapabilityInt64Atomics, "atomic operations on 64 bits"},
    {spv::CapabilityGroupNonUniform, "subgroup operations"},
};

/// Of what the device is made with; render/gpu/device.cpp.
constexpr std::array enabled = {spv::CapabilityMatrix,
                                spv::CapabilityShader,
                                spv::CapabilityInt64,
                                spv::CapabilityImageQuery,
                                spv::CapabilityRayTracingKHR,
                                spv::CapabilityPhysicalStorageBufferAddresses,
                                spv::CapabilityRuntimeDescriptorArray,
                                spv::CapabilityShaderNonUniform,
                                spv::CapabilitySampledImageArrayNonUniformIndexing};

/// What the device was not asked for would be undefined behaviour, or a message of the validation layer.
void refuse_other_capabilities(const scene::UserShapeCode& code, std::span<const std::uint32_t> spirv) {
    constexpr std::size_t header_words = 5;
    for (std::size_t at = header_words; at < spirv.size(); at += spirv[at] >> spv::WordCountShift) {
        if ((spirv[at] & spv::OpCodeMask) != spv::OpCapability) break;  // they come first
        const auto wanted = static_cast<spv::Capability>(spirv[at + 1]);
        if (std::ranges::find(enabled, wanted) != enabled.end()) continue;
        const auto known = std::ranges::find(not_enabled, wanted, &Capability::number);
        throw_bad_input(code.file.string(),
                        "needs " +
                            (known != std::end(not_enabled) ? std::string(known->name)
                                                            : "capability " + std::to_string(wanted)) +
                            ", which foveray does not ask of GPUs",
                        "write it without");
    }
}

std::vector<std::uint32_t> compile_stage(EShLanguage stage, const std::string& source,
                                         const scene::UserShapeCode& code) {
    static std::once_flag initialised;
    std::call_once(initialised, [] { glslang::InitializeProcess(); });

    glslang::TShader shader(stage);
    const char* text = source.c_str();
    const int length = static_cast<int>(source.size());
    shader.setStringsWithLengthsAndNames(&text, &length, &wrapper_name, 1);
    shader.setEnvInput(glslang::EShSourceGlsl, stage, glslang::EShClientVulkan, 100);
    shader.setEnvClient(glslang::EShClientVulkan, glslang::EShTargetVulkan_1_3);
    shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_6);
    const auto messages = static_cast<EShMessages>(EShMsgSpvRules | EShMsgVulkanRules);
    Includer includer(code);
    if (!shader.parse(GetDefaultResources(), 460, false, messages, includer)) {
        throw_first_error(code, shader.getInfoLog());
    }
    glslang::TProgram program;
    program.addShader(&shader);
    if (!program.link(messages)) throw_first_error(code, program.getInfoLog());
    std::vector<std::uint32_t> spirv;
    glslang::SpvOptions options;
    options.stripDebugInfo = true;
    glslang::GlslangToSpv(*program.getIntermediate(stage), spirv, &options);
    refuse_other_capabilities(code, spirv);
    return spirv;
}

/// An argument as the shader finds it in the record.
std::string value_of(const scene::UserValue& argument, const std::vector<scene::UserValue>& values) {
    if (argument.name == "time") return "record.time";
    std::uint32_t offset = 0;
    for (const scene::UserValue& value : values) {
        if (value.name == argument.name) break;
        offset += value.width;
    }
    if (argument.width == 1) return "record.values[" + std::to_string(offset) + "]";
    std::string list;
    for (std::uint32_t i = 0; i < argument.width; ++i) {
        list += (i == 0 ? "" : ", ") + ("record.values[" + std::to_string(offset + i) + "]");
    }
    return "vec" + std::to_string(argument.width) + "(" + list + ")";
}

std::string values_of(const std::vector<scene::UserShapeCode::Argument>& arguments,
                      const std::vector<scene::UserValue>& values) {
    std::string list;
    for (const auto& argument : arguments) list += ", " + value_of(argument.value, values);
    return list;
}

/// foveray's functions that call the user's with the record's values; their prototypes are in the snippets.
std::string calls(const scene::UserShape& shape) {
    const std::string more = values_of(shape.code.arguments, shape.values);
    if (shape.code.surface == scene::UserShapeCode::Surface::Distance) {
        return "float shape_distance(vec3 p) { return distance_at(p" + more + "); }\n";
    }
    return "bool shape_intersect(vec3 origin, vec3 direction, float t_min, float t_max, out float t, out "
           "vec3 normal) "
           "{\n    return intersect(origin, direction, t_min, t_max, t, normal" +
           more + ");\n}\n";
}

std::string color_call(const scene::UserShape& shape) {
    const std::string color =
        shape.code.color_arguments
            ? "color_at(p, normal" + values_of(*shape.code.color_arguments, shape.values) + ")"
            : "vec4(1.0)";
    return "vec4 shape_color(vec3 p, vec3 normal) { return " + color + "; }\n";
}

/// foveray's part `before` the user's file, so that a name of ours that the file takes is an error in the
/// file.
std::string wrap(const std::string& before, const std::string& after) {
    return "#version 460\n#extension GL_EXT_ray_tracing : require\n#extension GL_GOOGLE_include_directive : "
           "require\n" +
           before + "#include \"" + Includer::user_file + "\"\n" + after;
}

std::string include(const std::string& snippet) {
    return "#include \"shaders/render/shapes/" + snippet + "\"\n";
}

std::string kind_of(const scene::UserShape& shape) {
    return shape.code.surface == scene::UserShapeCode::Surface::Distance ? "distance" : "intersect";
}

}  // namespace

render::UserShader compile(const scene::UserShape& shape) {
    render::UserShader shader;
    shader.intersection = compile_stage(
        EShLangIntersect, wrap(include("user_" + kind_of(shape) + ".glsl"), calls(shape)), shape.code);
    const bool by_distance = shape.code.surface == scene::UserShapeCode::Surface::Distance;
    const std::string distance_call = by_distance ? calls(shape) : "";  // for the normal
    shader.closest_hit = compile_stage(
        EShLangClosestHit,
        wrap(include("user_" + kind_of(shape) + "_surface.glsl"), distance_call + color_call(shape)),
        shape.code);
    shader.uses_time = shape.code.uses_time();
    return shader;
}

std::vector<std::uint32_t> compile_examination(const scene::UserShape& shape) {
    return compile_stage(EShLangCompute, wrap(include("examine_" + kind_of(shape) + ".glsl"), calls(shape)),
                         shape.code);
}

}  // namespace foveray::user_shapes
