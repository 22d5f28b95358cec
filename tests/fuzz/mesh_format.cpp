// SPDX-License-Identifier: GPL-3.0-or-later
// The ending of the mesh files that a fuzzer is for, so that fuzz_mesh.cpp is compiled once.
namespace plyform::fuzz {

extern const char* const mesh_format;
const char* const mesh_format = PLYFORM_FUZZ_FORMAT;

} // namespace plyform::fuzz
