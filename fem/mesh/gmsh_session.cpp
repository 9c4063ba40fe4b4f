#include "fem/mesh/gmsh_session.hpp"

#include "lib/contract/require.hpp"

#include <gmsh.h>

#include <exception>

namespace impulse {
namespace {

std::mutex& gmsh_mutex() {
  static std::mutex mutex;
  return mutex;
}

}  // namespace

GmshSession::GmshSession() : alone_(gmsh_mutex()) {
  gmsh::initialize(0, nullptr, false);
  gmsh::option::setNumber("General.Terminal", 0);
  gmsh::option::setNumber("General.AbortOnError", 2);  // an error becomes an exception
  gmsh::option::setNumber("General.NumThreads", 1);
}

GmshSession::~GmshSession() {
  try {
    gmsh::finalize();
  } catch (...) {  // nothing left to release
  }
}

void GmshSession::run(const std::string& doing, const std::function<void()>& calls) const {
  const auto refuse = [&doing](const std::string& words) { require(false, "{}: {}", doing, words); };
  try {
    calls();
  } catch (const std::string& words) {  // some versions of Gmsh throw bare strings
    refuse(words);
  } catch (const std::invalid_argument&) {
    throw;
  } catch (const std::exception& error) {
    refuse(error.what());
  }
}

}  // namespace impulse
