# Calls tipp_optional_part(PART FOUND ...) with TIPP_USE_PART set to WANTED, and prints the result.
include("${SOURCE}/CMake/TIPPOptionalPart.cmake")
set(TIPP_USE_PART "${WANTED}")
tipp_optional_part(PART "${FOUND}" "it is not found; install it.")
message("with it: ${TIPP_HAS_PART}")
