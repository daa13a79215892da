/**
 * @file memory.hpp
 * The memory of this process and of the machine.
 */
#pragma once

#include <cstdint>

namespace elvis {

/** Bytes that the system can give without swapping; if it does not say, as many as there can be. */
std::uint64_t available_bytes();

/** In main memory now; 0 if the system does not tell. */
std::uint64_t resident_bytes();

/** Asked of malloc and not freed; 0 if the C library does not tell. */
std::uint64_t heap_bytes();

/**
 * Gives free memory of the heap back to the system. Threads that free most of what they took, such as a compiler's, leave it
 * with the C library, each in a heap of its own, in which others hardly find use for it. Takes some milliseconds, in which
 * other threads wait when they ask for memory.
 */
void give_back_free_memory();

} // namespace elvis
