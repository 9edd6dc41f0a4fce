#include "base/json.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <sstream>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wall"
#pragma GCC diagnostic ignored "-Wextra"
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validation_results.hpp>
#include <valijson/validator.hpp>
#pragma GCC diagnostic pop

#include "base/error.h"
#include "base/schema_words.h"

namespace foveray {

Json read_json(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    if (!in || std::filesystem::is_directory(file)) {
        throw_bad_input(file.string(), "cannot be opened", "check the path");
    }
    std::stringstream text;
    text << in.rdbuf();
    const std::string s = text.str();
    const auto place_of = [&](std::size_t byte) {
        const auto line = 1 + std::count(s.begin(), s.begin() + std::min(byte, s.size()), '\n');
        return file.string() + ":" + std::to_string(line);
    };
    try {
        return Json::parse(s);
    } catch (const Json::parse_error& e) {
        const std::string_view rest = std::string_view(s).substr(std::min(e.byte - 1, s.size()));
        for (const std::string word : {"Infinity", "NaN"}) {
            if (rest.starts_with(word))
                throw_bad_input(place_of(e.byte), word + " is no number in JSON", "give a number");
        }
        throw_bad_input(place_of(e.byte), "not valid JSON", "correct the syntax there");
    } catch (const Json::out_of_range& e) {
        // "number overflow parsing '1e999'"
        const std::string_view what = e.what();
        const std::size_t from = what.find('\'') + 1;
        const std::string number(what.substr(from, what.rfind('\'') - from));
        throw_bad_input(place_of(s.find(number)), number + " is too large a number", "correct it");
    }
}

void check_json(const Json& document, std::string_view schema_text, const std::filesystem::path& file) {
    using Adapter = valijson::adapters::NlohmannJsonAdapter;
    const Json schema_json = Json::parse(schema_text);
    valijson::Schema schema;
    valijson::SchemaParser parser;
    parser.populateSchema(Adapter(schema_json), schema);

    valijson::Validator validator;
    valijson::ValidationResults results;
    if (validator.validate(schema, Adapter(document), &results)) return;

    // Of the deepest errors the first one names the place that the user has to mend; the later ones only say
    // that a schema around it failed.
    valijson::ValidationResults::Error error, innermost;
    while (results.popError(error)) {
        if (error.context.size() > innermost.context.size()) innermost = error;
    }
    std::vector<std::string> steps;
    std::string place;
    for (const std::string& step : innermost.context) {
        if (step == "<root>") continue;
        steps.push_back(step.starts_with('[') ? step.substr(1, step.size() - 2) : step);
        place += "/" + steps.back();
    }
    const Complaint complaint =
        complaint_at(schema_json, document, steps)
            .value_or(Complaint{innermost.description, "see the format's JSON Schema"});
    throw_bad_input(file.string() + ": " + (place.empty() ? "/" : place), complaint.what, complaint.remedy);
}

Json shortest(float value) {
    char text[32];
    const auto [end, error] = std::to_chars(text, text + sizeof text, value);
    double number = 0.0;
    std::from_chars(text, end, number);
    return number;
}

void write_json(const std::filesystem::path& file, const Json& document) {
    std::ofstream out(file);
    out << document.dump(2) << '\n';
    if (!out.flush())
        throw_bad_input(file.string(), "cannot be written", "check the folder's rights and free space");
}

}  // namespace foveray
