/** What the program was built with, for the check that its processor has it; see processor_check.c. */
#pragma once

#ifdef __cplusplus
extern "C" {
#endif

enum { TSUNAGI_X86_64_V3 = 1, TSUNAGI_X86_64_V4 = 2 };
/** Which of the two the rest of the program needs; a constant, for no code may run before the check. */
extern const unsigned tsunagi_required_instructions;
/** Stands beside the check; who refers to it has the linker take the check in. */
extern const int tsunagi_processor_is_checked;

#ifdef __cplusplus
}
#endif
