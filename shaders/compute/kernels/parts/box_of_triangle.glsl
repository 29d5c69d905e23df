// The box of the triangle at a place in leaf order.
Box box_of_triangle(uint t) {
  return triangle_box(vec3(world_position[first_position + triangle[corner_of(t, 0u)]]),
                      vec3(world_position[first_position + triangle[corner_of(t, 1u)]]),
                      vec3(world_position[first_position + triangle[corner_of(t, 2u)]]));
}

// The boxes of four triangles from t on, so that their loads overlap. Beyond the last triangle before `end`, its box repeats.
struct FourBoxes { Box first; Box second; Box third; Box fourth; };

FourBoxes four_boxes(uint t, uint end) {
  FourBoxes four;
  four.first = box_of_triangle(t);
  four.second = box_of_triangle(min(t + 1u, end - 1u));
  four.third = box_of_triangle(min(t + 2u, end - 1u));
  four.fourth = box_of_triangle(min(t + 3u, end - 1u));
  return four;
}
