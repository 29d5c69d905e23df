#include "gl/allocation.hpp"

#include <glad/gl.h>

#include "core/expect.hpp"

namespace pliant::gl {

Allocation::Allocation() { glDisable(GL_DEBUG_OUTPUT); }

Allocation::~Allocation() { glEnable(GL_DEBUG_OUTPUT); }

bool Allocation::ran_out() const {
  const GLenum error = glGetError();
  PLIANT_EXPECT(error == GL_NO_ERROR || error == GL_OUT_OF_MEMORY);
  return error == GL_OUT_OF_MEMORY;
}

}  // namespace pliant::gl
