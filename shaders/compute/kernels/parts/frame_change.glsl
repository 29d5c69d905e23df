// How the body's frame changes. In quiet steps that stands beside what else groups tell each other.
#ifdef QUIET
#define CHANGE_OF(b) quiet_body[b].change
#else
#define CHANGE_OF(b) frame_change[b]
#endif
