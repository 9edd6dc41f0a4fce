#include <algorithm>
#include <iostream>

#include "app/commands.h"
#include "app/import/importers.h"
#include "base/json.h"
#include "base/staged_folder.h"

namespace foveray::app {

ExitCode run_import(const ImportOptions& options) {
    const auto table = importers();
    const auto importer =
        std::find_if(table.begin(), table.end(), [&](const Importer& i) { return i.name == options.format; });
    if (importer == table.end()) {
        throw_bad_input("--from " + options.format, "is no format", "`foveray import --help` lists them");
    }
    const Session session = importer->read(options.files);
    StagedFolder folder(options.out, "session.json");
    write_session(folder.path(), session);
    folder.commit();

    const auto valid =
        std::count_if(session.gaze.begin(), session.gaze.end(), [](const auto& g) { return g.valid; });
    if (options.json) {
        std::cout << Json{{"session", folder.target().string()},
                          {"headset", session.headset},
                          {"frames", session.frames},
                          {"seconds", to_seconds(session.duration())},
                          {"head_samples", session.head.size()},
                          {"gaze_samples", session.gaze.size()},
                          {"valid_gaze_samples", valid},
                          {"controller_samples", session.controllers.size()}}
                         .dump(2)
                  << '\n';
    } else {
        std::cout << folder.target().string() << ": " << session.frames << " frames, "
                  << to_seconds(session.duration()) << " s, " << session.head.size() << " head, "
                  << session.gaze.size() << " gaze (" << valid << " valid) and " << session.controllers.size()
                  << " controller samples\n";
    }
    return ExitCode::Done;
}

}  // namespace foveray::app
