#include "base/json.h"

#include <algorithm>
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

namespace foveray {

Json read_json(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    if (!in || std::filesystem::is_directory(file)) {
        throw_bad_input(file.string(), "cannot be opened", "check the path");
    }
    std::stringstream text;
    text << in.rdbuf();
    const std::string s = text.str();
    try {
        return Json::parse(s);
    } catch (const Json::parse_error& e) {
        const auto line = 1 + std::count(s.begin(), s.begin() + std::min(e.byte, s.size()), '\n');
        throw_bad_input(file.string() + ":" + std::to_string(line), "not valid JSON",
                        "correct the syntax there");
    } catch (const Json::out_of_range&) {
        throw_bad_input(file.string(), "holds a number that is too large", "correct it");
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
    std::string place;
    for (const std::string& step : innermost.context) {
        if (step == "<root>") continue;
        place += "/" + step.substr(step.front() == '[' ? 1 : 0, step.size() - (step.front() == '[' ? 2 : 0));
    }
    throw_bad_input(file.string() + ": " + (place.empty() ? "/" : place), innermost.description,
                    "see the JSON Schema in docs/");
}

void write_json(const std::filesystem::path& file, const Json& document) {
    std::ofstream out(file);
    out << document.dump(2) << '\n';
    if (!out.flush())
        throw_bad_input(file.string(), "cannot be written", "check the folder's rights and free space");
}

}  // namespace foveray
