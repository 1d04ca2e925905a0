#pragma once

// To be included before Highway. Registers whose length is known at run time only (SVE, RISC-V)
// can be no members and no elements of arrays; ARM has NEON.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
