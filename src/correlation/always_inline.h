#pragma once

// Inlined even into a function that is compiled for another instruction set.
#define TELESTRAIN_INLINE [[gnu::always_inline]] inline
