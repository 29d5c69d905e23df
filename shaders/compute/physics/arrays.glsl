// This is the one list of arrays. Kernels name them in READ, WRITE and SHARED_WRITE, and get slots by those names.
//
// A line is ARRAY(name, element, per, life, layout). An array per `run` belongs to the run as a whole. An array has one of these lives:
// - `fixed`: it is made from scene and meshes
// - `carried`: it outlasts a step and belongs to a saved state
// - `step`: it is written in a step before it is read there. The next step begins by reading contacts and their impulses once more, and
//   the response saves what it needs of them. Of a body at rest an array keeps what the latest step wrote that looked at the body
// docs/conventions.md repeats the layouts.

// bodies
ARRAY(rest_position, vec4, vertex, fixed, "x, y, z in the body's frame, about its centroid [m]; w: the body's index")
ARRAY(motion, double, vertex, carried, "[half][vertex][6] u [m], w [m/s]")
ARRAY(world_position, vec4, vertex, carried, "[half][vertex] x, y, z [m]; w: 1")
ARRAY(placement, real, vertex, carried, "[slot][2][vertex][4] position, then displacement, relative to the body's reference [body's unit]; slot 0 serves a step's start, and it alone is carried; slots 1 and 2 serve stages in turn, slot 3 notes what rounding has done; as many as the method needs")
ARRAY(body, Body, body, fixed, "material, and the range of vertices")
ARRAY(share, Share, share, fixed, "vertices that one work group of a force kernel serves, with their body")
ARRAY(pose, Pose, body, carried, "the body's moving frame, and what placements are relative to")
ARRAY(frame_change, FrameChange, body, step, "how the frame has followed the body at this step's end")
ARRAY(body_box, BoxBits, body, step, "of the world positions at the step's end, as bits that order as floats do; empty between steps, unless the body is at rest. Contact by impulses has cages in it first")
ARRAY(place_box, BoxBits, body, step, "the same of the places at the step's start, for contact by impulses")
ARRAY(status, Status, body, carried, "[body + 1] whether the body moves, is deformed, is finite; behind them the first vertex of all that is not")
ARRAY(tally, Tally, body, carried, "what was done for the body so far")
ARRAY(slow_place, vec4, body, carried, "[body][16] where the vertices that stand for the body were when its slow time began [m]; w: 1. Only if bodies may sleep")
ARRAY(slept, double, body, carried, "[body][4] energy that sleep has taken from the body's motion [J], then momentum that what bears it has taken for that [Ns]")
ARRAY(meeting, uint, body, step, "arrivals of work groups that wait for each other within a step, 0 between steps")
ARRAY(control, Control, run, carried, "the step's length, clock and counters")
ARRAY(quiet_body, QuietBody, body, step, "bounds within which steps are quiet, and what work groups tell each other of the body in them; also a list of the shares of bodies that move, so there are as many as groups that make such steps, at least")
ARRAY(kept_before, double, vertex, step, "[vertex][3] spring forces that a splitting method kept when a quiet step began [N]; one number where no step is quiet")
ARRAY(quiet_steps, QuietSteps, run, step, "how many quiet steps are made at once")

// integrators
ARRAY(kept_force, double, vertex, carried, "[vertex][3] spring forces of a splitting method at the step's start, and at its end for the next step [N]")
ARRAY(acceleration, double, vertex, step, "[stage][vertex][3] of a method with stages [m/s^2]; until then the stage's velocity; one number for a splitting")
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

// springs of clustered bodies
ARRAY(tree_vertex, uint, vertex, fixed, "[leaf][16] vertices of clustered bodies in the order of their trees; behind the end of a body's last leaf its last vertex again")
ARRAY(spring_cluster, SpringCluster, cluster, fixed, "of vertices, with its nodes; parents come before children")
ARRAY(spring_leaf, uvec4, leaf, fixed, "[leaf + 1] body, cluster, where the leaf's parts of `near_leaf` and `above_cluster` begin")
ARRAY(near_leaf, uint, pair, fixed, "leaves whose vertices a leaf's vertices see one by one, itself among them")
ARRAY(above_cluster, uint, pair, fixed, "clusters that hold a leaf and see others from far, itself among them")
ARRAY(far_cluster, uvec2, pair, fixed, "a cluster whose nodes the one that lists it sees, and where in `node_pull` the first leaf of the latter keeps what it pulls them with; clusters that see node 0 alone come first")
ARRAY(spring_point, real, point, step, "[point][2][4] placement as stages have it, and how many vertices the point stands for; then displacement, 0. Points are the places of trees, then [cluster][5] nodes")
ARRAY(leaf_moment, double, leaf, step, "[leaf][12] sums over its vertices (forces/clusters.glsl has units)")
ARRAY(leaf_pull, real, vertex, step, "[leaf][16][3] what pulls a vertex, of all that it sees [body's unit]")
ARRAY(node_pull, real, pair, step, "[cluster][row][12] what leaves of far clusters pull a cluster's nodes with, the other way (forces/clusters.glsl) [body's unit]; rows of node 0 come first")
ARRAY(cluster_pull, double, cluster, step, "[cluster][12] what its nodes hand down to its vertices (forces/clusters.glsl has units)")
ARRAY(leaf_square, double, leaf, step, "[leaf][3] sums over its vertices of squares: of what clusters hand down, of a vertex's sum, of parts of it; of a leaf of samples the first is the error [body's unit squared]")
ARRAY(spring_sum, double, vertex, step, "[vertex][3] what pulls a vertex of a body that is clustered, or that ranks share: minus the force over the stiffness [body's unit]; anything of other bodies, and of those that are not deformed")
ARRAY(sum_share, Share, share, fixed, "vertices whose springs this rank sums, if several simulate together")

// internal damping
ARRAY(moment_part, uvec4, part, fixed, "body, first vertex, end of vertices, a number that is not used: what a group sums of a body with internal damping")
ARRAY(moment_range, uvec2, body, fixed, "first part, number of parts; none without internal damping")
ARRAY(moment, double, part, step, "[part][15] sums over these vertices, in the order of Moments (rigid_motion.glsl)")
ARRAY(rigid_motion, RigidMotion, body, step, "what internal damping leaves alone, at a stage; zeros for bodies without it")

// contacts
ARRAY(tree, uvec4, body, fixed, "first treelet, number of treelets, first triangle, end of triangles")
ARRAY(treelet, Treelet, treelet, fixed, "nodes, and vertices, of a part of a body's tree that is refitted and searched as one; a body's follow each other")
ARRAY(treelet_vertex, uint, vertex, fixed, "of a treelet's triangles, each once; one number if refits are bottom-up")
ARRAY(treelet_step, uint, treelet, step, "the latest step in which it overlapped one of another body, or of its own if that may meet itself; one number if refits are bottom-up")
ARRAY(treelet_pair, uvec2, pair, step, "treelets of near bodies whose boxes overlap; one pair if refits are bottom-up")
ARRAY(node, uvec4, node, fixed, "of treelets, level by level: first child, one past the last child, height above the lowest leaf, 0; of a leaf 0, 0, first triangle, end of triangles")
ARRAY(node_box, vec4, node, step, "[node][2] lower, upper [m]")
ARRAY(triangle, uint, triangle, fixed, "[triangle][3] vertex indices, in leaf order")
ARRAY(near_pair, uvec4, pair, step, "two bodies, then the next pair of each by its number + 1, or 0; in no fixed order. A body that may meet itself is both, without links")
ARRAY(grid_list, uint, list, step, "the first body that stands in a list of the grid, by its number + 1; 0 between steps")
ARRAY(grid_entry, GridEntry, body, step, "where the body stands in the grid of boxes")
ARRAY(grid_level, uint, run, step, "[7] a bit for each level of the grid on which bodies stand; 0 between steps")
ARRAY(leaf_pair, uvec2, pair, step, "nodes of two leaves, in no fixed order")
ARRAY(mark, uint, vertex, carried, "latest step in which it touched another body; 0: none")

// contacts by impulses
ARRAY(surface, Surface, body, fixed, "what contacts know of the body")
ARRAY(step_parts, StepParts, run, carried, "how the scene's steps fall into parts")
ARRAY(body_motion, BoxBits, body, step, "of the velocities that its vertices are expected to have in a part as long as the last one, as bits that order as floats do; empty between steps")
ARRAY(room, Room, body, step, "how much further than expected its vertices may go; without bounds and pushes between steps")
ARRAY(pressed, uint, body, carried, "number of the latest part of a step in which a contact gave it an impulse, 0: none")
ARRAY(ground, Ground, ground, fixed, "half-spaces that bodies stay out of; one that nothing reaches where there are none")
ARRAY(contact_sum, uvec2, run, step, "[7 + body] sums in quanta, as 64 bits in two halves: impulse on bodies, which is what static and scripted bodies and grounds gave, then energy that contacts gave, that they took, what friction took of both, and what scripted bodies gave by moving; then what contacts that ended unsettled gave each body; 0 between steps")
ARRAY(contact_total, double, run, carried, "[7 + body] the same of all steps so far [Ns], [J]; but of each body only what it owes for the latest step")
ARRAY(start, double, vertex, step, "[vertex][6] where the vertex is at the step's start [m] and its velocity before the kick [m/s], in the world")
ARRAY(unkicked_velocity, double, vertex, step, "[vertex][3] the same velocity in the body's frame, for steps that are undone [m/s]; one number without a tolerance")
ARRAY(expected, double, vertex, step, "[vertex][3] mean velocity that the vertex is expected to have in the step, without a kick [m/s]")
ARRAY(surplus, real, vertex, carried, "[3][vertex][3] of the surplus over the step's length: what is expected in the coming step, then what the last step's end had, then the lead, if it counts (contact/surplus.glsl) [m/s^2]")
ARRAY(cage, vec2, vertex, step, "[vertex][2][3] a box: lower.xy, lower.z and upper.x, upper.yz. First where the vertex stays in the step, then the way it is expected to go, and later the way it went [m]")
ARRAY(contact_list, ContactList, run, step, "lengths of the lists of triangle pairs and contacts")
ARRAY(triangle_around, uint, triangle, fixed, "[triangle][4] in leaf order, once for all bodies of a mesh: the third vertex of the triangle across each edge, from the body's first vertex on, or 0xffffffff; then bits 0 to 2 for vertices that belong to the triangle, bits 3 to 5 for edges")
ARRAY(triangle_pair, uvec2, pair, step, "two triangles whose cages overlap, in leaf order, the second with the bit ways_meet; pairs are in no fixed order")
ARRAY(contact_vertex, uvec4, contact, step, "four vertices; contacts are in no fixed order")
ARRAY(contact, real, contact, step, "[contact][6][4] physics/contact/contact.glsl has the rows")
ARRAY(contact_impulse, real, contact, step, "[contact][4] impulse along the normal, then across it [Ns]")
ARRAY(kept_slot, uint, slot, step, "contacts of the last step by their keys: the step's number, then the contact's")
ARRAY(kept_key, uvec4, contact, step, "key of a contact of the last step (kept_slots.glsl)")
ARRAY(kept_impulse, real, contact, step, "[contact][4] its impulse along the normal, then across it [Ns]")
ARRAY(contact_weight, uint, vertex, step, "sum of its weights in contacts, in 2^-13; 0 once it is kicked")
ARRAY(impulse_sum, uvec2, vertex, step, "[3][vertex][3] impulses of a kick in quanta, as 64 bits in two halves")
ARRAY(way, double, vertex, step, "[vertex][3] how far the integrator moved the vertex beyond its flight [m]")
ARRAY(cut, uint, vertex, step, "[row][vertex] part of its way that a vertex may go, as bits of a float; the least counts. The next row says in which round it was stopped, if at all; then of each flight when it was stopped (contact/surface.glsl)")
ARRAY(vertex_part, uvec4, part, fixed, "body, first vertex, end of vertices, parts of a block: what one thread serves of a body that moves")
ARRAY(vertex_part_range, uvec2, body, fixed, "first part, number of parts; none for a body that does not move")
ARRAY(part_sum, PartSums, part, step, "sums over these vertices, if a body owes energy or had motions cut short")
ARRAY(cluster, Cluster, body, carried, "[body + 1] how bodies fly, and bodies held by each other, where the first of them stands; the last one counts those in clusters")
ARRAY(island_scale, uint, body, step, "[body][2] of an island, at its first body: the largest mass [kg] and the largest component of a velocity [m/s], as bits of floats; 0 between steps")
ARRAY(island_sum, uvec2, body, step, "[body][4] of an island, at its first body: momentum, then mass, in quanta as 64 bits in two halves; 0 between steps")
ARRAY(debt, Debt, body, carried, "[body + 1] what the body owes; the last one is the sum")
ARRAY(impact_partner, uint, impact, carried, "[body][64] the partner of each impact that the body keeps: its number + 1, or the number of bodies + 1 for the grounds; 0: the place is free; in no fixed order")
ARRAY(impact_sum, uvec2, impact, carried, "[body][64][3] sum of the impulses of the pair's contacts in an impact, on the body, as 64 bits in two halves")
ARRAY(impact_approach, double, impact, carried, "[body][64] the largest speed at which the centres of mass came [m/s], 0: none yet")
ARRAY(impact_part, uint, impact, carried, "[body][64] number of the latest part of a step in which the pair got an impulse, 0: none; behind these for each body whether it lacked a place; then the latest part of all")
ARRAY(last_cut, uint, vertex, carried, "1: its motion was cut short in the last step")

// scripted bodies
ARRAY(path, Path, body, carried, "how it goes along its keys")
ARRAY(path_key, PathKey, key, carried, "the keys of all paths, one path after another")
ARRAY(path_state, PathState, body, carried, "where its path leads in the step in hand, and its own clock")

// pulls
ARRAY(aim, Aim, run, step, "where a grip is drawn to, and by how much its velocity changes")
ARRAY(grip, GripVertex, run, fixed, "vertices that a pull holds, with their weights")
