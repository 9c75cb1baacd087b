/* Ends a program with one line, not with a signal, on a processor that lacks instructions it was built with.
 *
 * Runs before any other code of the program, and is itself built for the oldest processors; so it is C, calls nothing of
 * the C++ library, and learns from a constant (build_information.cpp) what the rest was built with. */
#include "common/processor_check.h"

#include <string.h>
#include <unistd.h>

const int tsunagi_processor_is_checked = 1;

#if defined(__x86_64__)
#include <cpuid.h>

static int has_vector_state(unsigned mask) {
    unsigned low, high;
    __asm__ volatile("xgetbv" : "=a"(low), "=d"(high) : "c"(0));
    return (low & mask) == mask;
}

/* The instructions of x86-64-v3 (System V ABI) and, beyond them, the AVX-512 of x86-64-v4. */
static unsigned missing_instructions(void) {
    unsigned a, b, c, d, basic, extended = 0, more = 0;
    if (!__get_cpuid(1, &a, &b, &basic, &d)) return tsunagi_required_instructions;
    if (__get_cpuid_count(7, 0, &a, &b, &c, &d)) extended = b;
    if (__get_cpuid(0x80000001u, &a, &b, &c, &d)) more = c;
    const unsigned v3_basic = bit_FMA | bit_MOVBE | bit_OSXSAVE | bit_AVX | bit_F16C;
    const unsigned v3_extended = bit_BMI | bit_AVX2 | bit_BMI2;
    const unsigned v4_extended = bit_AVX512F | bit_AVX512DQ | bit_AVX512BW | bit_AVX512VL | bit_AVX512CD;
    const int has_v3 = (basic & v3_basic) == v3_basic && (extended & v3_extended) == v3_extended &&
                       (more & bit_LZCNT) != 0 && has_vector_state(0x6);
    const int has_v4 = has_v3 && (extended & v4_extended) == v4_extended && has_vector_state(0xe6);
    return tsunagi_required_instructions &
           ~((has_v3 ? TSUNAGI_X86_64_V3 : 0u) | (has_v4 ? TSUNAGI_X86_64_V4 : 0u));
}
#else
static unsigned missing_instructions(void) {
    return 0;
}
#endif

static void say(const char* text) {
    if (write(STDERR_FILENO, text, strlen(text)) < 0) _exit(1);
}

__attribute__((constructor(101))) static void check_processor(void) {
    const unsigned missing = missing_instructions();
    if (missing == 0) return;
    say("tsunagi: this processor lacks instructions that the program was built with (");
    say((missing & TSUNAGI_X86_64_V3) != 0 ? "x86-64-v3: AVX2, FMA, BMI2" : "x86-64-v4: AVX-512");
    say("); build it here with cmake -D TSUNAGI_INSTRUCTION_SET=native, or run it on another machine\n");
    _exit(1);
}
