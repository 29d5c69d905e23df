// A kernel that views numbers of fp64 as if they were of fp32. No pass of it can be recorded.
READ_AS(motion, vec4, moved)
WRITE(mark)

void misread(uint i) { mark[i] = uint(moved[i].x); }
