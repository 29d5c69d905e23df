// This is the one list of arrays. Kernels name them in READ, WRITE and SHARED_WRITE, and get slots by those names.
//
// A line is ARRAY(name, element, per, life, layout). An array per `run` belongs to the run as a whole. An array has one of these lives:
// - `fixed`: it is made from scene and meshes
// - `carried`: it outlasts a step and belongs to a saved state
// - `step`: it is written in a step before it is read there
// docs/conventions.md repeats the layouts.

// bodies
ARRAY(rest_position, vec4, vertex, fixed, "x, y, z in the body's frame, about its centroid [m]; w: the body's index")
ARRAY(motion, double, vertex, carried, "[half][vertex][6] u [m], w [m/s]")
ARRAY(world_position, vec4, vertex, carried, "[half][vertex] x, y, z [m]; w: 1")
ARRAY(placement, real, vertex, carried, "[slot][2][vertex][4] position, then displacement, relative to the body's reference [body's unit]; slots 0 and 1 serve stages in turn, slot 2 a step's start, which alone is carried, slot 3 notes what rounding has done")
ARRAY(body, Body, body, fixed, "material, and the range of vertices")
ARRAY(share, Share, share, fixed, "vertices that one work group of a force kernel serves, with their body")
ARRAY(pose, Pose, body, carried, "the body's moving frame, and what placements are relative to")
ARRAY(frame_change, FrameChange, body, step, "how the frame has followed the body at this step's end")
ARRAY(body_box, BoxBits, body, step, "of the world positions at the step's end, as bits that order as floats do; empty between steps")
ARRAY(status, Status, body, carried, "whether the body moves, is deformed, is finite")
ARRAY(tally, Tally, body, carried, "what was done for the body so far")
ARRAY(meeting, uint, body, step, "arrivals of work groups that wait for each other within a step, 0 between steps")
ARRAY(control, Control, run, carried, "the step's length, clock and counters")

// integrators
ARRAY(kept_force, double, vertex, carried, "[vertex][3] spring forces of a splitting method, kept for the next step [N]")
ARRAY(acceleration, double, vertex, step, "[stage][vertex][3] of a method with stages [m/s^2]; until then the stage's velocity")
ARRAY(tableau, dvec2, run, fixed, "rows as runge_kutta_stage and splitting_stage read them, one tableau after another")
ARRAY(error_weight, double, stage, fixed, "[stage][4] of the step's distance to the embedded method's, in position and velocity; then the second one's")
ARRAY(error_scale, double, body, fixed, "[body][2] 1 / r [1/m], 1 / (r omega) [s/m]")
ARRAY(pace, Pace, run, carried, "how long steps are where a tolerance governs them")

// forces beside the springs
ARRAY(added_force, double, vertex, step, "[vertex][3] of all forces but the springs at a stage, which reads them [N]; one number where there are none")
ARRAY(pressure, Pressure, body, fixed, "inside the body, if it has any")
ARRAY(shell_triangle, uint, triangle, fixed, "[triangle][3] vertices of bodies with pressure, counter-clockwise seen from outside")
ARRAY(shell_part, uvec4, part, fixed, "body, first triangle, end of triangles, 0: what one thread sums")
ARRAY(volume_part, double, part, step, "what these triangles add to the body's volume [m^3]")
ARRAY(fan_begin, uint, vertex, fixed, "[vertex + 1] where the vertex's triangles begin in `fan`")
ARRAY(fan, uvec2, corner, fixed, "the other two vertices of a triangle around a vertex, in its order")

// contacts
ARRAY(tree, uvec2, body, fixed, "root, number of leaves")
ARRAY(node, uvec4, node, fixed, "left child (the right one is next; 0: leaf), parent, first triangle, end of triangles; behind all trees x: the nodes that searches start from")
ARRAY(node_box, vec4, node, step, "[node][2] lower, upper [m]")
ARRAY(leaf, uvec2, leaf, fixed, "node, body")
ARRAY(triangle, uint, triangle, fixed, "[triangle][3] vertex indices, in leaf order")
ARRAY(arrival, uint, node, step, "children refitted so far, 0 between steps")
ARRAY(partner_step, uint, body, step, "latest step in which its box overlapped another's")
ARRAY(near_pair, uvec2, pair, step, "two bodies, in no fixed order")
ARRAY(leaf_pair, uvec2, pair, step, "nodes of two leaves, in no fixed order")
ARRAY(mark, uint, vertex, carried, "latest step in which it touched another body; 0: none")

// pulls
ARRAY(aim, Aim, run, step, "where a grip is drawn to, and by how much its velocity changes")
ARRAY(grip, GripVertex, run, fixed, "vertices that a pull holds, with their weights")
