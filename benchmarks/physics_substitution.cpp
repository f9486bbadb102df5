// Time to get rid of the equations of motion and the contacts: in closed form, by a QR of their
// rows, and by the solver's own sweep over them. Counter Q: the time over that of Eigen's
// HouseholderQR of a 30 × 30 matrix; the argument is the number of feet on the ground. And the time
// to see contact forces in what these levels leave free: each row of friction and of force
// minimisation, as the solver does it, or the forces once and the rows by them.

#include "surefoot/tasks/physics_substitution.hpp"

#include "surefoot/model/robot_model.hpp"
#include "surefoot/solver/lexicographic_solver.hpp"
#include "surefoot/tasks/equations_of_motion.hpp"
#include "surefoot/tasks/friction_cone.hpp"
#include "surefoot/tasks/no_contact_motion.hpp"
#include "tests/support/anymal_b.hpp"
#include "tests/support/random_motion.hpp"

#include <Eigen/QR>
#include <benchmark/benchmark.h>

namespace surefoot::test {
namespace {

constexpr int kNumVelocities = 6 + kNumLegJoints, kNumUnknowns = kNumVelocities + kNumLegJoints;

/// One standing robot, its contacts and the rows of both tasks.
class Example {
 public:
  explicit Example(int num_contacts) : model_(anymal_b()), hierarchy_(kNumUnknowns) {
    plan_ = plan_with_contacts(
        {num_contacts > 0, num_contacts > 2, num_contacts > 3, num_contacts > 1});
    dynamics_ =
        model_.update(Random(1).standing_state(model_.description().q_nominal), Vec3::UnitZ());
    support_.update(dynamics_, plan_);
    const tasks::TaskInput input{dynamics_, plan_, support_, model_.description()};
    const tasks::EquationsOfMotion equations_of_motion;
    const tasks::NoContactMotion no_contact_motion({});
    hierarchy_.add_level("equations_of_motion", kNumVelocities);
    hierarchy_.add_level("no_contact_motion", kNumLegJoints);
    equations_of_motion.write(input, hierarchy_.level(0));
    no_contact_motion.write(input, hierarchy_.level(1));
  }

  [[nodiscard]] const model::Dynamics& dynamics() const { return dynamics_; }
  [[nodiscard]] const model::SupportDynamics& support() const { return support_; }
  [[nodiscard]] const solver::Hierarchy& hierarchy() const { return hierarchy_; }

 private:
  model::RobotModel model_;
  MotionPlan plan_;
  model::Dynamics dynamics_;
  model::SupportDynamics support_;
  solver::Hierarchy hierarchy_;
};

void BM_ClosedForm(benchmark::State& state) {
  const Example example(static_cast<int>(state.range(0)));
  const Eigen::VectorXd contact = example.hierarchy().level(1).lower();
  tasks::PhysicsSubstitution substitution{kNumLegJoints};
  for (auto _ : state) {
    benchmark::DoNotOptimize(substitution.update(example.dynamics(), example.support(), contact));
  }
}
BENCHMARK(BM_ClosedForm)->DenseRange(0, 4);

void BM_QR(benchmark::State& state) {
  const Example example(static_cast<int>(state.range(0)));
  Eigen::MatrixXd rows(kNumVelocities, kNumUnknowns);
  rows << example.hierarchy().level(0).A(), example.hierarchy().level(1).A();
  const Eigen::MatrixXd transposed = rows.transpose();
  Eigen::HouseholderQR<Eigen::MatrixXd> qr(kNumUnknowns, kNumVelocities);
  Eigen::MatrixXd basis(kNumUnknowns, kNumUnknowns);
  Eigen::VectorXd workspace(kNumUnknowns);
  for (auto _ : state) {
    qr.compute(transposed);
    qr.householderQ().evalTo(basis, workspace);
    benchmark::DoNotOptimize(basis.data());
  }
}
BENCHMARK(BM_QR)->DenseRange(0, 4);

void BM_Sweep(benchmark::State& state) {
  const Example example(static_cast<int>(state.range(0)));
  solver::LexicographicSolver solver(example.hierarchy());
  for (auto _ : state) benchmark::DoNotOptimize(solver.solve(example.hierarchy()).x.data());
}
BENCHMARK(BM_Sweep)->DenseRange(0, 4);

/// Rows a leg of both tasks.
constexpr int kForceRows = tasks::FrictionCone::kRowsPerLeg + 3;

void BM_EachForceRow(benchmark::State& state) {
  const Example example(static_cast<int>(state.range(0)));
  tasks::PhysicsSubstitution physics{kNumLegJoints};
  const solver::Substitution& substitution =
      *physics.update(example.dynamics(), example.support(), example.hierarchy().level(1).lower());
  const Eigen::MatrixXd rows =
      Eigen::MatrixXd::Random(kForceRows * example.support().num_contacts(), kNumUnknowns);
  Eigen::MatrixXd reduced(rows.rows(), substitution.basis.cols());
  for (auto _ : state) {
    reduced.noalias() = rows * substitution.basis;
    benchmark::DoNotOptimize(reduced.data());
  }
}
BENCHMARK(BM_EachForceRow)->DenseRange(2, 4);

void BM_ForcesOnce(benchmark::State& state) {
  const Example example(static_cast<int>(state.range(0)));
  tasks::PhysicsSubstitution physics{kNumLegJoints};
  const solver::Substitution& substitution =
      *physics.update(example.dynamics(), example.support(), example.hierarchy().level(1).lower());
  const int legs = example.support().num_contacts();
  const Eigen::Matrix<double, kForceRows, 3> of_a_leg = Eigen::MatrixXd::Random(kForceRows, 3);
  Eigen::MatrixXd forces(3 * legs, substitution.basis.cols());
  Eigen::MatrixXd reduced(kForceRows * legs, substitution.basis.cols());
  for (auto _ : state) {
    forces.noalias() = example.support().Lambda() * substitution.basis;
    for (int leg = 0; leg < legs; ++leg) {
      reduced.middleRows<kForceRows>(kForceRows * leg).noalias() =
          of_a_leg * forces.middleRows<3>(3 * leg);
    }
    benchmark::DoNotOptimize(reduced.data());
  }
}
BENCHMARK(BM_ForcesOnce)->DenseRange(2, 4);

void BM_Q(benchmark::State& state) {
  const Eigen::MatrixXd A = Eigen::MatrixXd::Random(30, 30);
  Eigen::HouseholderQR<Eigen::MatrixXd> qr(30, 30);
  for (auto _ : state) {
    qr.compute(A);
    benchmark::DoNotOptimize(qr.matrixQR().data());
  }
}
BENCHMARK(BM_Q);

}  // namespace
}  // namespace surefoot::test

BENCHMARK_MAIN();
