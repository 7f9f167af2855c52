#include "bench/oracle/oracle.h"

#include <memory>

namespace clucida::oracle {

std::vector<std::vector<Face>> faces(const scene::Scene& scene)
{
    scene::Scene solids = scene;
    solids.sky = scene::SkyColor{}; // photographs are not needed
    solids.textures.clear();
    for (scene::Object& object : solids.objects) object.texture.reset();
    const auto world = std::make_shared<const World<double>>(build<double>(solids, {}));
    std::vector<std::vector<Face>> all;
    for (const Object<double>& object : world->objects) {
        std::vector<Face>& faces = all.emplace_back();
        for (const Primitive<double>& p : object.primitives) {
            // The world is held for as long as any of its faces.
            faces.push_back({[world, &p](scene::Vec3 v) { return value_at(p, {v.x, v.y, v.z}); }});
        }
    }
    return all;
}

} // namespace clucida::oracle
