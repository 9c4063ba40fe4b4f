// Solids of revolution: mesh, assembly, factorisation, modes and response of the cone that meets a rod with its large
// end.
#include "fem/bodies/axisymmetric_solid.hpp"
#include "fem/implicit/newmark.hpp"
#include "fem/implicit/step_response.hpp"
#include "fem/mesh/solid_mesh.hpp"
#include "impulse/response/modal_response.hpp"
#include "lib/model/modal_model.hpp"

#include <benchmark/benchmark.h>

namespace {

using namespace impulse;

/// About 1300 and 20 000 elements.
SolidMeshOptions mesh_options(bool large) {
  return large ? SolidMeshOptions{1.05, 0.045} : SolidMeshOptions{1.15, 0.21};
}

TriangleMesh cone_mesh(bool large) {
  return solid_mesh({parse_segment("400mm,30mm,75mm,nylon-6:0.40")}, {{Face::b, 5e-3, 0.25e-3}}, mesh_options(large));
}

Structure cone(const TriangleMesh& mesh) {
  return axisymmetric_structure({.mesh = mesh,
                                 .materials = {isotropic_elasticity(parse_material("nylon-6:0.40"))},
                                 .contacts = {{Face::b, 5e-3, CircleContact::punch}}})
      .structure;
}

ModalModel modes(const Structure& body) {
  return modal_model(body, {.mode_count = 200, .residual = ModalOptions::Residual::attached});
}

void solid_mesh_of(benchmark::State& state) {
  Eigen::Index elements = 0;
  for (auto _ : state) elements = cone_mesh(state.range(0) == 1).element_count();
  state.counters["elements"] = static_cast<double>(elements);
}
BENCHMARK(solid_mesh_of)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

void solid_assembly(benchmark::State& state) {
  const TriangleMesh mesh = cone_mesh(state.range(0) == 1);
  for (auto _ : state) benchmark::DoNotOptimize(cone(mesh));
  state.counters["elements"] = static_cast<double>(mesh.element_count());
}
BENCHMARK(solid_assembly)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

void solid_factorisation(benchmark::State& state) {
  const Structure body = cone(cone_mesh(state.range(0) == 1));
  for (auto _ : state) benchmark::DoNotOptimize(Newmark(body, 1e-6));
}
BENCHMARK(solid_factorisation)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

void solid_200_modes(benchmark::State& state) {
  const Structure body = cone(cone_mesh(state.range(0) == 1));
  for (auto _ : state) benchmark::DoNotOptimize(modes(body));
}
BENCHMARK(solid_200_modes)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond)->Iterations(1);

/// From the drawing to the response.
void solid_response_by_modes(benchmark::State& state) {
  const UniformGrid grid = grid_over(1e-3, 1e-6);
  for (auto _ : state) benchmark::DoNotOptimize(modal_response(modes(cone(cone_mesh(state.range(0) == 1))), grid));
}
BENCHMARK(solid_response_by_modes)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond)->Iterations(1);

void solid_response_by_steps(benchmark::State& state) {
  const UniformGrid grid = grid_over(1e-3, 1e-6);
  for (auto _ : state)
    benchmark::DoNotOptimize(
        step_displacements(cone(cone_mesh(state.range(0) == 1)), grid, {.substeps = 2, .observer = {}}));
}
BENCHMARK(solid_response_by_steps)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond)->Iterations(1);

}  // namespace
