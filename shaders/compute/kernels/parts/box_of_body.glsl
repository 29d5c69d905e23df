// The body's box [m]. Needs the array `body_box`.
Box box_of_body(uint b) { return box_of_bits(body_box[b]); }
