// The box of the triangle at a place in leaf order.
Box box_of_triangle(uint t) {
  return triangle_box(vec3(world_position[first_position + triangle[corner_of(t, 0u)]]),
                      vec3(world_position[first_position + triangle[corner_of(t, 1u)]]),
                      vec3(world_position[first_position + triangle[corner_of(t, 2u)]]));
}
