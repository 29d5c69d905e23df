// Reads the tables of a scene that stand for bodies: [[body]], with rows and paths, and [[container]].
#pragma once
#include <vector>

#include "scene/scene_description.hpp"
#include "scene/toml.hpp"

namespace pliant {
class TableReader;

/// Reads the keys of what touches others, of a body, a container or a ground.
void read_surface(TableReader& table, SurfaceDescription& surface);

/// Appends the bodies of the array `node`. Throws Error (input or command_line).
void read_bodies(const toml::node& node, std::vector<BodyDescription>& bodies);

/// Appends the containers of the array `node`, each as a rigid body, and scripted if something moves it. Throws Error (input or
/// command_line).
void read_containers(const toml::node& node, std::vector<BodyDescription>& bodies);

}  // namespace pliant
