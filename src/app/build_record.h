#pragma once

namespace telestrain {

// How this program was built. Its own source, made at every build and compiled when it differs, so
// that another revision does not compile anything else again.
struct BuildRecord {
  const char* revision;  // of the source, with -dirty when it was changed; "unknown" without git
  const char* build_type;
  const char* compiler;  // "GNU 12.2.0"
  const char* flags;
};
extern const BuildRecord kBuildRecord;

}  // namespace telestrain
