/*
 * Uses the installed library of the native volume: spaces, and HDF5 behind the reader.
 */
#include <elvis/native/space.hpp>
#include <elvis/native/volume_file.hpp>

int main() { return elvis::native::Reader::probe("/does/not/exist") == 0 ? 0 : 1; }
