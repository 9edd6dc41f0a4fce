#include "render/user_shapes/shape_store.h"

#include "base/error.h"
#include "render/user_shapes/compile.h"
#include "render/user_shapes/probe_request.h"

namespace foveray::user_shapes {

render::UserShaders ShapeStore::prepare(const scene::Scene& scene) {
    render::UserShaders shaders;
    for (scene::UserShapeId id = 0; id < scene.user_shapes.size(); ++id) {
        shaders.push_back(prepare(scene, id, scene.user_shapes[id].code));
    }
    return shaders;
}

render::UserShader ShapeStore::prepare(const scene::Scene& scene, scene::UserShapeId id,
                                       const scene::UserShapeCode& code) {
    const scene::UserShape user{code, scene.user_shapes[id].values};
    for (const scene::Shape& shape : scene.shapes) {
        if (shape.kind != scene::ShapeKind::User || shape.user != id) continue;
        std::vector<scene::UserValue> given = user.values;
        if (shape.user_time) given.push_back({"time", 1});
        if (const auto misfit = scene::find_misfit(code, given)) {
            throw_bad_input(code.file.string() + ":" + std::to_string(misfit->line), misfit->what,
                            misfit->remedy);
        }
    }
    const std::string key = to_json(make_request(scene, user, id)).dump();
    const auto found = good_.find(key);
    if (found != good_.end()) return found->second;
    probe(scene, user, id, options_);
    return good_.emplace(key, compile(user)).first->second;
}

}  // namespace foveray::user_shapes
