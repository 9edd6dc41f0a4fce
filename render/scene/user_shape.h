#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace foveray::scene {

/// A number or vector that a user's shape is given by its name.
struct UserValue {
    std::string name;
    std::uint32_t width = 1;  // numbers, 1 to 4

    bool operator==(const UserValue&) const = default;
};

/// A user's GLSL file, read as far as its three functions' argument lists; docs/user-shapes.md. Whether the
/// rest compiles, render/user_shapes finds out.
struct UserShapeCode {
    static constexpr std::uint32_t most_numbers = 16;      // of all values together, besides `time`
    static constexpr std::uintmax_t most_bytes = 1 << 18;  // of a file

    enum class Surface { Distance, Intersection };
    struct Argument {
        UserValue value;
        std::uint32_t line = 0;  // counted from 1
    };

    std::filesystem::path file;
    std::string text;
    Surface surface = Surface::Distance;
    std::uint32_t line = 0;           // where the surface's function is
    std::vector<Argument> arguments;  // of the surface's function, after the fixed ones
    std::optional<std::vector<Argument>>
        color_arguments;  // of color_at, after the fixed ones; empty: not defined
    std::uint32_t color_line = 0;

    /// Name of the function that defines the surface.
    std::string_view function() const;
    bool uses_time() const;
};

/// A user's file in a scene, with the values that each of its objects has: sorted by name, without `time`.
struct UserShape {
    UserShapeCode code;
    std::vector<UserValue> values;
};

/// Reads a file. Throws Fault(BadInput) with file and line when it is missing, too large, or defines no
/// shape.
UserShapeCode read_user_shape(const std::filesystem::path& file);
UserShapeCode parse_user_shape(const std::filesystem::path& file, std::string text);

/// Where arguments and values do not fit.
struct UserMisfit {
    std::string value;       // the given value at fault; empty: one is missing
    std::uint32_t line = 0;  // of the argument or the function
    std::string what, remedy;
};
/// Arguments are matched with values by name; `time` may be left out.
std::optional<UserMisfit> find_misfit(const UserShapeCode& code, std::span<const UserValue> given);

}  // namespace foveray::scene
