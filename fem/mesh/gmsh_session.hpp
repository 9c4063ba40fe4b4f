#pragma once

#include <functional>
#include <mutex>
#include <string>

namespace impulse {

/// Gmsh for the life of the object: one at a time in a process, silent, reading no user configuration, so that the same
/// input gives the same mesh. Its errors leave `run` as std::invalid_argument with Gmsh's own words.
class GmshSession {
 public:
  GmshSession();
  GmshSession(const GmshSession&) = delete;
  GmshSession& operator=(const GmshSession&) = delete;
  ~GmshSession();

  /// @throws std::invalid_argument `doing: what Gmsh says`.
  void run(const std::string& doing, const std::function<void()>& calls) const;

 private:
  std::unique_lock<std::mutex> alone_;
};

}  // namespace impulse
