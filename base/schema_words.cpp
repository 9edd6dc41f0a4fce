#include "base/schema_words.h"

#include <algorithm>

#include "base/text.h"

namespace foveray {
namespace {

using Schemas = std::vector<const Json*>;

std::string a_type(const std::string& type) {
    if (type == "array") return "a list";
    if (type == "boolean") return "true or false";
    if (type == "integer") return "a whole number";
    if (type == "object") return "an object {…}";
    if (type == "string") return "a text in quotes";
    return type == "null" ? "null" : "a number";
}

bool has_type(const Json& value, const std::string& type) {
    if (type == "integer") return value.is_number_integer();
    return type == value.type_name();  // "number", "string", …
}

/// Lists and objects are too long to repeat.
std::string not_what_it_is(const Json& value) {
    return ", not " + (value.is_structured() ? a_type(value.type_name()) : value.dump());
}

std::string listed(const Json& values) {
    std::string text;
    for (std::size_t i = 0; i < values.size(); ++i)
        text += (i == 0 ? "" : i + 1 == values.size() ? " or " : ", ") + values[i].dump();
    return text;
}

/// Conditions on the values of an object's keys; any other counts as not met.
bool holds(const Json& condition, const Json& value) {
    if (!condition.contains("properties") || !value.is_object()) return false;
    for (const auto& [key, expected] : condition["properties"].items()) {
        if (!value.contains(key) || !expected.contains("const") || value[key] != expected["const"])
            return false;
    }
    return true;
}

/// `schema` and all that it joins to itself for this value.
void join(Schemas& joined, const Json& root, const Json& schema, const Json& value) {
    joined.push_back(&schema);
    if (schema.contains("$ref"))
        join(joined, root, root.at(Json::json_pointer(schema["$ref"].get<std::string>().substr(1))), value);
    if (schema.contains("allOf"))
        for (const Json& part : schema["allOf"]) join(joined, root, part, value);
    if (schema.contains("if") && schema.contains("then") && holds(schema["if"], value))
        join(joined, root, schema["then"], value);
}

Schemas joined(const Json& root, const Json& schema, const Json& value) {
    Schemas all;
    join(all, root, schema, value);
    return all;
}

/// What the schema says of the value that `step` leads to.
const Json* child(const Json& schema, const Json& value, const std::string& step) {
    if (value.is_array()) return schema.contains("items") ? &schema["items"] : nullptr;
    if (schema.contains("properties") && schema["properties"].contains(step))
        return &schema["properties"][step];
    const bool others = schema.contains("additionalProperties") && schema["additionalProperties"].is_object();
    return others ? &schema["additionalProperties"] : nullptr;
}

std::optional<Complaint> about_number(const Json& schema, const Json& value) {
    const double number = value.get<double>();
    const auto limit = [&](const char* keyword, const char* words, auto broken) -> std::optional<Complaint> {
        if (!schema.contains(keyword) || !broken(number, schema[keyword].get<double>())) return std::nullopt;
        return Complaint{
            "must be " + std::string(words) + " " + schema[keyword].dump() + not_what_it_is(value),
            "correct the value"};
    };
    if (auto c = limit("minimum", "at least", std::less<>())) return c;
    if (auto c = limit("exclusiveMinimum", "above", std::less_equal<>())) return c;
    if (auto c = limit("maximum", "at most", std::greater<>())) return c;
    return limit("exclusiveMaximum", "below", std::greater_equal<>());
}

std::optional<Complaint> about_list(const Json& schema, const Json& value) {
    const auto least = schema.value("minItems", std::size_t{0});
    const auto most = schema.value("maxItems", value.size());
    if (value.size() < least || value.size() > most) {
        const std::string count = least == most          ? std::to_string(least)
                                  : value.size() < least ? "at least " + std::to_string(least)
                                                         : "at most " + std::to_string(most);
        return Complaint{"must hold " + count + " values, not " + std::to_string(value.size()),
                         "add or remove some"};
    }
    if (schema.value("uniqueItems", false)) {
        for (std::size_t i = 0; i < value.size(); ++i) {
            if (std::find(value.begin(), value.begin() + static_cast<int>(i), value[i]) !=
                value.begin() + static_cast<int>(i))
                return Complaint{"holds " + value[i].dump() + " twice", "remove one"};
        }
    }
    return std::nullopt;
}

std::optional<Complaint> about_object(const Schemas& all, const Json& schema, const Json& value) {
    if (schema.contains("required")) {
        for (const std::string key : schema["required"]) {
            if (!value.contains(key)) return Complaint{"lacks \"" + key + "\"", "add it"};
        }
    }
    if (schema.value("additionalProperties", Json()) != Json(false)) return std::nullopt;
    std::vector<std::string_view> known;
    for (const Json* part : all) {
        if (!part->contains("properties")) continue;
        for (const auto& entry : (*part)["properties"].items()) known.push_back(entry.key());
    }
    for (const auto& entry : value.items()) {
        if (schema.contains("properties") && schema["properties"].contains(entry.key())) continue;
        return Complaint{"holds \"" + entry.key() + "\", which means nothing here",
                         known.empty()
                             ? "remove it"
                             : "did you mean \"" + std::string(nearest(entry.key(), known)) + "\"?"};
    }
    return std::nullopt;
}

std::optional<Complaint> complaint(const Json& root, const Json& schema, const Json& value);

std::optional<Complaint> about(const Json& root, const Schemas& all, const Json& schema, const Json& value) {
    if (schema.contains("type") && schema["type"].is_string() && !has_type(value, schema["type"])) {
        return Complaint{"must be " + a_type(schema["type"]) + not_what_it_is(value), "correct the value"};
    }
    if (schema.contains("const") && value != schema["const"])
        return Complaint{"must be " + schema["const"].dump() + not_what_it_is(value), "correct the value"};
    if (schema.contains("enum") &&
        std::find(schema["enum"].begin(), schema["enum"].end(), value) == schema["enum"].end())
        return Complaint{"must be " + listed(schema["enum"]) + not_what_it_is(value), "correct the value"};
    if (schema.contains("anyOf")) {
        std::string ways;
        for (const Json& way : schema["anyOf"]) {
            const auto found = complaint(root, way, value);
            if (!found) return std::nullopt;
            // All of them end with what it is instead.
            ways += (ways.empty() ? "" : " or ") + found->what.substr(0, found->what.rfind(", not "));
        }
        return Complaint{ways + not_what_it_is(value), "correct the value"};
    }
    if (value.is_number()) return about_number(schema, value);
    if (value.is_array()) return about_list(schema, value);
    if (value.is_object()) return about_object(all, schema, value);
    if (value.is_string()) {
        const std::size_t length = value.get_ref<const std::string&>().size();
        if (length < schema.value("minLength", std::size_t{0})) return Complaint{"is empty", "fill it in"};
        if (length > schema.value("maxLength", length)) return Complaint{"is too long", "shorten it"};
        if (schema.contains("pattern"))
            return Complaint{"must look like " + schema["pattern"].dump() + not_what_it_is(value),
                             "correct the value"};
    }
    return std::nullopt;
}

std::optional<Complaint> complaint(const Json& root, const Json& schema, const Json& value) {
    const Schemas all = joined(root, schema, value);
    for (const Json* part : all) {
        if (auto found = about(root, all, *part, value)) return found;
    }
    return std::nullopt;
}

}  // namespace

std::optional<Complaint> complaint_at(const Json& schema, const Json& document,
                                      const std::vector<std::string>& place) {
    const Json* value = &document;
    Schemas here = joined(schema, schema, document);
    for (const std::string& step : place) {
        const Json& next = value->is_array() ? value->at(std::stoul(step)) : value->at(step);
        Schemas below;
        for (const Json* part : here) {
            if (const Json* found = child(*part, *value, step)) join(below, schema, *found, next);
        }
        here = std::move(below);
        value = &next;
    }
    for (const Json* part : here) {
        if (auto found = about(schema, here, *part, *value)) return found;
    }
    return std::nullopt;
}

}  // namespace foveray
