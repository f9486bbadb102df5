// DAQP: dual active set; its own hierarchical mode, and as a solver of general QPs in a cascade.

#include "benchmarks/solver/qp_cascade.hpp"

#include <api.h>
extern "C" {
#include <utils.h>
}

#include <map>
#include <utility>

namespace surefoot::benchmarks {
namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Eigen::Index;

/// Levels are blocks of rows that end at break points; the first is hard, the others are softened
/// one after the other. Default settings. The workspace stays while the levels keep their sizes.
class Hierarchical final : public Peer {
 public:
  explicit Hierarchical(bool is_warm) : is_warm_(is_warm) { daqp_default_settings(&settings_); }
  ~Hierarchical() override { release(); }

  void prepare(const solver::Hierarchy& problem) override {
    remember();
    const std::vector<int> old_ends = std::exchange(ends_, {});
    load(problem);
    if (old_ends != ends_ || !is_set_up_) set_up();
    recall();
  }

  bool solve() override {
    if (!is_set_up_) return false;  // it takes no such problem
    result_.x = x_.data();
    result_.lam = multipliers_.data();
    const int mask = DAQP_UPDATE_M | DAQP_UPDATE_d | DAQP_UPDATE_sense | DAQP_UPDATE_hierarchy;
    result_.exitflag = daqp_update_ldp(mask, &work_, &qp_);
    if (result_.exitflag < 0) return false;
    daqp_solve(&result_, &work_);
    return result_.exitflag > 0;
  }

  const Eigen::VectorXd& x() const override { return x_; }

 private:
  using Key = std::pair<int, int>;  // level and id of a row

  void load(const solver::Hierarchy& problem) {
    Index rows = 0;
    for (std::size_t k = 0; k < problem.num_levels(); ++k) {
      rows += problem.level(k).num_rows();
      ends_.push_back(static_cast<int>(rows));
    }
    A_.resize(rows, problem.unknowns());
    lower_.resize(rows);
    upper_.resize(rows);
    keys_.clear();
    for (std::size_t k = 0; k < problem.num_levels(); ++k) {
      const solver::Level& level = problem.level(k);
      const Index first = ends_[k] - level.num_rows();
      A_.middleRows(first, level.num_rows()) = level.A();
      lower_.segment(first, level.num_rows()) = level.lower().cwiseMax(-DAQP_INF);
      upper_.segment(first, level.num_rows()) = level.upper().cwiseMin(DAQP_INF);
      for (Index i = 0; i < level.num_rows(); ++i) {
        keys_.emplace_back(static_cast<int>(k), level.id(i));
      }
    }
    x_.setZero(problem.unknowns());
    multipliers_.setZero(rows);
    sense_.assign(static_cast<std::size_t>(rows), 0);
  }

  void set_up() {
    release();
    qp_ = {};
    qp_.n = static_cast<int>(A_.cols());
    qp_.m = static_cast<int>(A_.rows());
    qp_.A = A_.data();
    qp_.bupper = upper_.data();
    qp_.blower = lower_.data();
    qp_.sense = sense_.data();
    qp_.break_points = ends_.data();
    qp_.nh = static_cast<int>(ends_.size());
    work_ = {};
    work_.settings = &settings_;
    is_set_up_ = setup_daqp(&qp_, &work_, nullptr) >= 0;
  }

  void release() {
    if (!is_set_up_) return;
    work_.settings = nullptr;
    free_daqp_workspace(&work_);
    free_daqp_ldp(&work_);
    is_set_up_ = false;
  }

  /// The rows that were active, by name: DAQP's own guess, carried across changes of the rows.
  void remember() {
    active_.clear();
    if (!is_warm_ || !is_set_up_) return;
    for (std::size_t i = 0; i < keys_.size(); ++i) {
      const int flags = work_.sense[i] & (DAQP_ACTIVE | DAQP_LOWER);
      if ((flags & DAQP_ACTIVE) != 0) active_[keys_[i]] = flags;
    }
  }

  void recall() {
    for (std::size_t i = 0; i < keys_.size(); ++i) {
      const auto found = active_.find(keys_[i]);
      if (found != active_.end()) sense_[i] = found->second;
    }
    qp_.A = A_.data();
    qp_.bupper = upper_.data();
    qp_.blower = lower_.data();
    qp_.sense = sense_.data();
    qp_.break_points = ends_.data();
  }

  bool is_warm_;
  bool is_set_up_ = false;
  DAQPSettings settings_{};
  DAQPProblem qp_{};
  DAQPWorkspace work_{};
  DAQPResult result_{};
  RowMajor A_;
  Eigen::VectorXd lower_, upper_, x_, multipliers_;
  std::vector<int> ends_, sense_;
  std::vector<Key> keys_;
  std::map<Key, int> active_;
};

class General final : public QpSolver {
 public:
  bool solve(const Qp& qp, Eigen::VectorXd& y) override {
    RowMajor H = qp.H, C = qp.C;
    Eigen::VectorXd g = qp.g, lower = qp.lower.cwiseMax(-DAQP_INF),
                    upper = qp.upper.cwiseMin(DAQP_INF), multipliers(qp.C.rows());
    DAQPProblem problem{};
    problem.n = static_cast<int>(H.cols());
    problem.m = static_cast<int>(C.rows());
    problem.H = H.data();
    problem.f = g.data();
    problem.A = C.data();
    problem.bupper = upper.data();
    problem.blower = lower.data();
    DAQPSettings settings{};
    daqp_default_settings(&settings);
    settings.primal_tol = 1e-9;
    y.setZero(H.cols());
    DAQPResult result{};
    result.x = y.data();
    result.lam = multipliers.data();
    daqp_quadprog(&result, &problem, &settings);
    return result.exitflag > 0;
  }
};

}  // namespace

void add_daqp(std::vector<PeerKind>& peers) {
  peers.push_back(
      {"DAQP hierarchical, warm", true, [] { return std::make_unique<Hierarchical>(true); }});
  peers.push_back(
      {"DAQP hierarchical", false, [] { return std::make_unique<Hierarchical>(false); }});
  peers.push_back({"DAQP cascade", false,
                   [] { return std::make_unique<QpCascade>(std::make_unique<General>(), false); }});
}

}  // namespace surefoot::benchmarks
