// The words that keys of scenes can have, for reading and writing them.
#pragma once
#include "scene/values.hpp"

namespace pliant::words {

enum class ContainerShape { box, sphere };

inline const std::vector<Choice<DampingLaw>> damping_laws = {{name_of(DampingLaw::none), DampingLaw::none},
                                                             {name_of(DampingLaw::constant), DampingLaw::constant},
                                                             {name_of(DampingLaw::adaptive), DampingLaw::adaptive},
                                                             {name_of(DampingLaw::internal), DampingLaw::internal}};
inline const std::vector<Choice<BodyKind>> kinds = {
    {"soft", BodyKind::soft}, {"static", BodyKind::immovable}, {"scripted", BodyKind::scripted}};
inline const std::vector<Choice<Subdivision>> subdivisions = {{"midpoint", Subdivision::midpoint}, {"loop", Subdivision::loop}};
inline const std::vector<Choice<ForceSum>> force_sums = {
    {"auto", ForceSum::automatic}, {"direct", ForceSum::direct}, {"clustered", ForceSum::clustered}};
inline const std::vector<Choice<ContactSearch>> searches = {{"tree", ContactSearch::tree},
                                                            {"brute_force", ContactSearch::brute_force}};
inline const std::vector<Choice<TriangleTest>> triangle_tests = {{"certified", TriangleTest::certified},
                                                                 {"moller", TriangleTest::moller}};
inline const std::vector<Choice<PressureLaw>> pressure_laws = {{"gas", PressureLaw::gas}, {"constant", PressureLaw::constant}};
inline const std::vector<Choice<TreeSplit>> splits = {
    {"centre", TreeSplit::centre}, {"median", TreeSplit::median}, {"surface_area", TreeSplit::surface_area}};
inline const std::vector<Choice<TreeRefit>> refits = {{"bottom_up", TreeRefit::bottom_up}, {"hybrid", TreeRefit::hybrid}};
inline const std::vector<Choice<Coloring>> colorings = {{"body", Coloring::body}, {"deformation", Coloring::deformation}};
inline const std::vector<Choice<Marks>> all_marks = {{"none", Marks::none}, {"contacts", Marks::contacts}};
inline const std::vector<Choice<ContainerShape>> container_shapes = {{"box", ContainerShape::box},
                                                                     {"sphere", ContainerShape::sphere}};

}  // namespace pliant::words
