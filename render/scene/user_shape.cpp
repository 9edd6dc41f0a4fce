#include "render/scene/user_shape.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>

#include "base/error.h"

namespace foveray::scene {
namespace {

struct Token {
    std::string text;
    std::uint32_t line = 0;
};

struct Parameter {
    bool out = false, in = true;
    std::string type, name;
    std::uint32_t line = 0;
};

struct Function {
    std::string name, type;
    std::vector<Parameter> parameters;
    std::uint32_t line = 0;
};

const std::string type_names[] = {"float", "vec2", "vec3", "vec4"};

std::uint32_t width_of(const std::string& type) {
    const auto found = std::ranges::find(type_names, type);
    return found == std::end(type_names) ? 0 : static_cast<std::uint32_t>(found - type_names) + 1;
}

/// Words and signs, without comments and preprocessor lines.
std::vector<Token> tokens_of(const std::string& text) {
    std::vector<Token> tokens;
    std::uint32_t line = 1;
    bool line_start = true;
    const auto is_word = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; };
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        const std::string_view rest(text.data() + i, text.size() - i);
        if (c == '\n') {
            ++line;
            line_start = true;
        } else if (rest.starts_with("//") || (c == '#' && line_start)) {
            for (; i + 1 < text.size() && text[i + 1] != '\n'; ++i) {
                if (text[i] != '\\' || i + 2 >= text.size()) continue;
                if (text[i + 1] == '\n') ++line, ++i;
            }
        } else if (rest.starts_with("/*")) {
            const std::size_t end = std::min(text.find("*/", i + 2), text.size() - 1);
            line +=
                static_cast<std::uint32_t>(std::count(text.begin() + static_cast<std::ptrdiff_t>(i),
                                                      text.begin() + static_cast<std::ptrdiff_t>(end), '\n'));
            i = end + 1;
        } else if (is_word(c)) {
            std::size_t end = i;
            while (end < text.size() && is_word(text[end])) ++end;
            tokens.push_back({text.substr(i, end - i), line});
            i = end - 1;
            line_start = false;
        } else if (!std::isspace(static_cast<unsigned char>(c))) {
            tokens.push_back({std::string(1, c), line});
            line_start = false;
        }
    }
    return tokens;
}

[[noreturn]] void fault(const std::filesystem::path& file, std::uint32_t line, const std::string& what,
                        const std::string& remedy) {
    throw_bad_input(file.string() + ":" + std::to_string(line), what, remedy);
}

class Reader {
  public:
    Reader(const std::filesystem::path& file, const std::string& text)
        : file_(file), tokens_(tokens_of(text)) {}

    /// Definitions, not prototypes, of the functions that a shape may have.
    std::vector<Function> functions() const {
        std::vector<Function> found;
        int depth = 0;
        for (std::size_t i = 0; i < tokens_.size(); ++i) {
            if (is(i, "{")) ++depth;
            if (is(i, "}")) --depth;
            if (depth != 0 || i == 0 || !is(i + 1, "(")) continue;
            if (!is(i, "distance_at") && !is(i, "intersect") && !is(i, "color_at")) continue;
            const std::size_t close = end_of_list(i + 1);
            if (!is(close + 1, "{")) continue;
            found.push_back(
                {tokens_[i].text, tokens_[i - 1].text, parameters(i + 2, close), tokens_[i].line});
        }
        return found;
    }

  private:
    bool is(std::size_t i, std::string_view text) const {
        return i < tokens_.size() && tokens_[i].text == text;
    }

    std::size_t end_of_list(std::size_t open) const {
        for (std::size_t i = open + 1; i < tokens_.size(); ++i) {
            if (is(i, ")")) return i;
        }
        fault(file_, tokens_[open].line, "has a list of arguments without an end", "add the missing )");
    }

    std::vector<Parameter> parameters(std::size_t from, std::size_t end) const {
        std::vector<Parameter> list;
        while (from < end) {
            std::size_t next = from;
            while (next < end && !is(next, ",")) ++next;
            list.push_back(parameter(from, next));
            from = next + 1;
        }
        return list;
    }

    Parameter parameter(std::size_t from, std::size_t end) const {
        static const std::array<std::string, 5> ignored = {"const", "in", "highp", "mediump", "lowp"};
        Parameter p;
        p.line = tokens_[from].line;
        std::vector<std::string> words;
        for (std::size_t i = from; i < end; ++i) {
            const std::string& word = tokens_[i].text;
            if (word == "out" || word == "inout") {
                p.out = true;
                p.in = word == "inout";
            } else if (std::ranges::find(ignored, word) == ignored.end()) {
                words.push_back(word);
            }
        }
        if (words.size() != 2)
            fault(file_, p.line, "has an argument that is no type and name", "write float twist");
        p.type = words[0];
        p.name = words[1];
        return p;
    }

    const std::filesystem::path& file_;
    std::vector<Token> tokens_;
};

struct Signature {
    std::string name, type;
    std::vector<Parameter> fixed;
    std::string text;
};

const Signature& signature_of(const std::string& name) {
    static const std::vector<Signature> signatures = {
        {"distance_at", "float", {{false, true, "vec3", "", 0}}, "float distance_at(vec3 p, …)"},
        {"intersect",
         "bool",
         {{false, true, "vec3", "", 0},
          {false, true, "vec3", "", 0},
          {false, true, "float", "", 0},
          {false, true, "float", "", 0},
          {true, false, "float", "", 0},
          {true, false, "vec3", "", 0}},
         "bool intersect(vec3 origin, vec3 direction, float t_min, float t_max, out float t, out vec3 "
         "normal, …)"},
        {"color_at",
         "vec4",
         {{false, true, "vec3", "", 0}, {false, true, "vec3", "", 0}},
         "vec4 color_at(vec3 p, vec3 normal, …)"},
    };
    return *std::ranges::find(signatures, name, &Signature::name);
}

/// What stands after the fixed arguments.
std::vector<UserShapeCode::Argument> arguments_of(const std::filesystem::path& file,
                                                  const Function& function) {
    const Signature& signature = signature_of(function.name);
    const auto fits = [](const Parameter& a, const Parameter& b) {
        return a.type == b.type && a.out == b.out;
    };
    if (function.type != signature.type || function.parameters.size() < signature.fixed.size() ||
        !std::equal(signature.fixed.begin(), signature.fixed.end(), function.parameters.begin(), fits)) {
        fault(file, function.line,
              function.name + " has other arguments or another type than foveray calls it with",
              "write " + signature.text);
    }
    std::vector<UserShapeCode::Argument> arguments;
    for (std::size_t i = signature.fixed.size(); i < function.parameters.size(); ++i) {
        const Parameter& p = function.parameters[i];
        const std::uint32_t width = width_of(p.type);
        if (width == 0 || p.out) {
            fault(file, p.line,
                  "the argument \"" + p.name + "\" of " + function.name + " cannot be given a value",
                  "make it a float, vec2, vec3 or vec4, and not out");
        }
        arguments.push_back({{p.name, width}, p.line});
    }
    return arguments;
}

std::string type_name(std::uint32_t width) { return type_names[width - 1]; }

/// What reaches beyond the shader that the shape becomes a part of.
void refuse_resources(const std::filesystem::path& file, const std::string& text) {
    for (const Token& token : tokens_of(text)) {
        if (token.text != "layout") continue;
        fault(file, token.line, "asks for memory or textures with \"layout\"", "take numbers as arguments");
    }
    static const std::regex extension("^[ \\t]*#[ \\t]*extension\\b");
    std::istringstream lines(text);
    std::string line;
    for (std::uint32_t number = 1; std::getline(lines, line); ++number) {
        if (!std::regex_search(line, extension)) continue;
        fault(file, number, "asks for an extension of GLSL", "write it without");
    }
}

}  // namespace

std::string_view UserShapeCode::function() const {
    return surface == Surface::Distance ? "distance_at" : "intersect";
}

bool UserShapeCode::uses_time() const {
    const auto is_time = [](const Argument& a) { return a.value.name == "time"; };
    return std::ranges::any_of(arguments, is_time) ||
           (color_arguments && std::ranges::any_of(*color_arguments, is_time));
}

UserShapeCode read_user_shape(const std::filesystem::path& file) {
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(file, error);
    if (error || !std::filesystem::is_regular_file(file)) {
        throw_bad_input(file.string(), "cannot be read as a shape", "name a GLSL file");
    }
    if (size > UserShapeCode::most_bytes) {
        throw_bad_input(file.string(), "is too large for a shape",
                        "a shape has up to " + std::to_string(UserShapeCode::most_bytes / 1024) + " KiB");
    }
    std::ifstream in(file, std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(in), {}};
    if (!in) throw_bad_input(file.string(), "cannot be read", "check its permissions");
    if (text.find('\0') != std::string::npos)
        throw_bad_input(file.string(), "is no text", "name a GLSL file");
    return parse_user_shape(file, std::move(text));
}

UserShapeCode parse_user_shape(const std::filesystem::path& file, std::string text) {
    UserShapeCode code;
    code.file = file;
    code.text = std::move(text);
    refuse_resources(file, code.text);
    bool has_surface = false;
    for (const Function& function : Reader(file, code.text).functions()) {
        std::vector<UserShapeCode::Argument> arguments = arguments_of(file, function);
        if (function.name == "color_at") {
            if (code.color_arguments)
                fault(file, function.line, "color_at is defined twice", "keep one of them");
            code.color_arguments = std::move(arguments);
            code.color_line = function.line;
            continue;
        }
        if (has_surface) {
            fault(file, function.line, "the shape is defined twice", "keep one of distance_at and intersect");
        }
        has_surface = true;
        code.line = function.line;
        code.surface = function.name == "intersect" ? UserShapeCode::Surface::Intersection
                                                    : UserShapeCode::Surface::Distance;
        code.arguments = std::move(arguments);
    }
    if (!has_surface) {
        throw_bad_input(file.string(), "defines neither distance_at nor intersect",
                        "define " + signature_of("distance_at").text);
    }
    return code;
}

std::optional<UserMisfit> find_misfit(const UserShapeCode& code, std::span<const UserValue> given) {
    const std::string file = code.file.filename().string();
    std::vector<UserShapeCode::Argument> arguments = code.arguments;
    if (code.color_arguments) {
        arguments.insert(arguments.end(), code.color_arguments->begin(), code.color_arguments->end());
    }
    std::uint32_t numbers = 0;
    for (const UserValue& value : given) {
        if (value.name != "time") numbers += value.width;
        if (std::ranges::none_of(arguments, [&](const auto& a) { return a.value.name == value.name; })) {
            return UserMisfit{value.name, code.line, "\"" + value.name + "\" is no argument in " + file,
                              "leave it out, or add it to " + std::string(code.function())};
        }
    }
    for (const UserShapeCode::Argument& argument : arguments) {
        const auto found = std::ranges::find(given, argument.value.name, &UserValue::name);
        const std::string name = "\"" + argument.value.name + "\"";
        if (argument.value.name == "time" && argument.value.width != 1) {
            return UserMisfit{"", argument.line, "the argument \"time\" is in seconds", "make it a float"};
        }
        if (found == given.end() && argument.value.name != "time") {
            return UserMisfit{"", argument.line,
                              file + " takes " + name + ", which has no value in the scene",
                              "add it to the parameters: " + type_name(argument.value.width)};
        }
        if (found != given.end() && found->width != argument.value.width) {
            return UserMisfit{found->name, argument.line,
                              name + " has " + std::to_string(found->width) + " numbers, but is a " +
                                  type_name(argument.value.width) + " in " + file,
                              "give " + std::to_string(argument.value.width)};
        }
    }
    if (numbers > UserShapeCode::most_numbers) {
        return UserMisfit{"", code.line, file + " takes " + std::to_string(numbers) + " numbers in all",
                          "a shape has at most " + std::to_string(UserShapeCode::most_numbers)};
    }
    return std::nullopt;
}

}  // namespace foveray::scene
