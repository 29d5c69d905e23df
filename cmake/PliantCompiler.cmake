# Warnings, sanitizers and floating-point rules, the same for every target.
function(pliant_compile_options target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
    $<$<BOOL:${PLIANT_WARNINGS_AS_ERRORS}>:-Werror>
    # The CPU must make the bits that the shaders make: no fused multiply-add, no reassociation.
    -ffp-contract=off -fno-math-errno -fno-trapping-math)
endfunction()

if(PLIANT_SANITIZE)
  add_compile_options(-fsanitize=${PLIANT_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  add_compile_options(-Wno-maybe-uninitialized)  # gcc 12 misreads the sanitizers' own code in <functional> and <regex>
  add_link_options(-fsanitize=${PLIANT_SANITIZE})
endif()
