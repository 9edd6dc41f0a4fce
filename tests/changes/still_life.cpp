#include "tests/changes/still_life.h"

#include <algorithm>
#include <cstdlib>

#include <glm/gtx/quaternion.hpp>

namespace foveray::app {

StillLife::StillLife(vec3 environment) {
    builder.set(scene::constant_environment(environment));
    scene::Node table;
    scene::Mesh top = scene::make_box({3.0f, 0.1f, 3.0f});
    top.primitives[0].material = builder.add(matte(vec3(0.6f)));
    table.mesh = builder.add(std::move(top));
    table.local.translation = {0.0f, -0.6f, -2.0f};
    builder.add(std::move(table));
    add_ball({0.0f, -0.6f, -2.0f}, matte(vec3(0.5f)));
    builder.set_local(static_cast<scene::NodeId>(builder.so_far().nodes.size() - 1),
                      {{0.0f, -0.6f, -2.0f}, quat(1, 0, 0, 0), vec3(0.1f)});
}

Offscreen& Easel::put(const scene::Scene& scene) {
    const auto show = [&](std::shared_ptr<const scene::Scene> shown) {
        if (offscreen_)
            offscreen_->show(offscreen_->prepare(std::move(shown)));
        else
            offscreen_.emplace(device_, std::move(shown), 2);
        return &*offscreen_;
    };
    show(std::make_shared<const scene::Scene>(StillLife().build()))->draw(front_shot(0, 1));
    return *show(std::make_shared<const scene::Scene>(scene));
}

Easel::Drawn Easel::draw(const scene::Scene& scene, const Shot& shot) {
    Offscreen& offscreen = put(scene);
    offscreen.finish();
    offscreen.draw(shot);
    const ShotCost cost = offscreen.finish().back();
    return {offscreen.picture(0), cost.rays};
}

scene::NodeId StillLife::add_box(vec3 place, const scene::Material& material,
                                 std::vector<scene::Presence> when) {
    scene::Mesh mesh = scene::make_box(vec3(0.25f));
    mesh.primitives[0].material = builder.add(material);
    scene::Node node;
    node.mesh = builder.add(std::move(mesh));
    node.local.translation = place;
    node.present = std::move(when);
    return builder.add(std::move(node));
}

scene::NodeId StillLife::add_ball(vec3 place, const scene::Material& material,
                                  std::vector<scene::Presence> when) {
    scene::Shape shape;
    shape.kind = scene::ShapeKind::Sphere;
    shape.values = {0.25f};
    shape.material = builder.add(material);
    scene::Node node;
    node.shape = builder.add(std::move(shape));
    node.local.translation = place;
    node.present = std::move(when);
    return builder.add(std::move(node));
}

scene::NodeId StillLife::add_lamp(vec3 place, vec3 direction, vec3 radiance,
                                  std::vector<scene::Presence> when) {
    scene::AreaLight lamp{"lamp", scene::AreaLightShape::Rectangle, vec3(0.15f), radiance};
    scene::Node node;
    node.area_light = builder.add(std::move(lamp));
    node.local.translation = place;
    node.local.rotation = glm::rotation(vec3(0.0f, 0.0f, -1.0f), glm::normalize(direction));
    node.present = std::move(when);
    return builder.add(std::move(node));
}

scene::Material matte(vec3 color) {
    scene::Material material;
    material.base_color = vec4(color, 1.0f);
    material.metallic = 0.0f;
    return material;
}

scene::Material unlit(vec3 color) {
    scene::Material material = matte(color);
    material.unlit = true;
    return material;
}

Shot front_shot(Nanoseconds time, std::uint32_t pixels) {
    Shot shot;
    View view;
    view.size = uvec2(pixels);
    view.fov = {-0.5f, 0.5f, 0.5f, -0.5f};
    shot.views = {view};
    shot.time = time;
    shot.settings.shadow_samples = 4;
    shot.settings.ambient_occlusion_samples = 1;
    shot.settings.probe_rays = 32;
    return shot;
}

Shot side_shot(Nanoseconds time, std::uint32_t pixels) {
    Shot shot = front_shot(time, pixels);
    shot.every_pixel = false;
    shot.acuity = {.a = 60.0f, .b = 3.0f, .cap_ppd = 20.0f, .outer_degrees = 85.0f};
    shot.gaze_direction = glm::normalize(vec3(-1.0f, 0.2f, -1.0f));
    return shot;
}

int largest_difference(const Image& a, const Image& b) {
    int largest = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        largest = std::max(largest, std::abs(int{a.pixels[i]} - int{b.pixels[i]}));
    return largest;
}

double mean_difference(const Image& a, const Image& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) sum += std::abs(int{a.pixels[i]} - int{b.pixels[i]});
    return sum / static_cast<double>(a.pixels.size());
}

}  // namespace foveray::app
