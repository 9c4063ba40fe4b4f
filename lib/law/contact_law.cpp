#include "lib/law/contact_law.hpp"

#include "lib/contract/require.hpp"

#include <cmath>
#include <limits>
#include <utility>

namespace impulse {

class ContactLaw::Model {
 public:
  virtual ~Model() = default;

  /// For α ≥ 0.
  [[nodiscard]] virtual LawPoint loading(double indentation_m) const = 0;
  /// For α0 ≤ α ≤ αm, αm > 0; energies from α0.
  [[nodiscard]] virtual LawPoint path(double indentation_m, const LawHistory& history) const = 0;
  [[nodiscard]] virtual double permanent_indentation_m(double largest_indentation_m) const = 0;
  [[nodiscard]] virtual double last_indentation_m() const { return std::numeric_limits<double>::infinity(); }
};

namespace {

using Path = LawHistory::Path;

LawPoint three_halves(double stiffness, double indentation) {
  const double root = std::sqrt(indentation);
  const double force = stiffness * indentation * root;
  return {force, 1.5 * stiffness * root, force * indentation / 2.5};
}

class Linear : public ContactLaw::Model {
 public:
  explicit Linear(double stiffness) : stiffness_(stiffness) {}
  [[nodiscard]] LawPoint loading(double indentation_m) const override {
    const double force = stiffness_ * indentation_m;
    return {force, stiffness_, 0.5 * force * indentation_m};
  }
  [[nodiscard]] LawPoint path(double indentation_m, const LawHistory& /*history*/) const override {
    return loading(indentation_m);
  }
  [[nodiscard]] double permanent_indentation_m(double /*largest_indentation_m*/) const override { return 0; }

 private:
  double stiffness_;
};

class Hertz : public ContactLaw::Model {
 public:
  explicit Hertz(double stiffness) : stiffness_(stiffness) {}
  [[nodiscard]] LawPoint loading(double indentation_m) const override {
    return three_halves(stiffness_, indentation_m);
  }
  [[nodiscard]] LawPoint path(double indentation_m, const LawHistory& /*history*/) const override {
    return loading(indentation_m);
  }
  [[nodiscard]] double permanent_indentation_m(double /*largest_indentation_m*/) const override { return 0; }

 private:
  double stiffness_;
};

class TanSun : public ContactLaw::Model {
 public:
  TanSun(double stiffness, double beta, double critical) : stiffness_(stiffness), beta_(beta), critical_(critical) {}
  [[nodiscard]] LawPoint loading(double indentation_m) const override {
    return three_halves(stiffness_, indentation_m);
  }
  [[nodiscard]] LawPoint path(double indentation_m, const LawHistory& history) const override {
    const double permanent = permanent_indentation_m(history.largest_indentation_m);
    const double length = history.largest_indentation_m - permanent;
    const double x = (indentation_m - permanent) / length;
    const double exponent = history.path == Path::unloading ? 2.5 : 1.5;
    const double power = history.path == Path::unloading ? x * std::sqrt(x) : std::sqrt(x);  // x^(exponent - 1)
    const double force = history.largest_force_N * x * power;
    return {force, exponent * history.largest_force_N / length * power, force * x * length / (exponent + 1)};
  }
  [[nodiscard]] double permanent_indentation_m(double largest_indentation_m) const override {
    return largest_indentation_m > critical_ ? beta_ * (largest_indentation_m - critical_) : 0;
  }

 private:
  double stiffness_, beta_, critical_;
};

class Table : public ContactLaw::Model {
 public:
  explicit Table(LawTable table) : curves_(std::move(table)) {}
  [[nodiscard]] LawPoint loading(double indentation_m) const override { return curves_.loading(indentation_m); }
  [[nodiscard]] LawPoint path(double indentation_m, const LawHistory& history) const override {
    return curves_.unloading(indentation_m, history.largest_indentation_m, history.largest_force_N);
  }
  [[nodiscard]] double permanent_indentation_m(double largest_indentation_m) const override {
    return curves_.permanent_indentation_m(largest_indentation_m);
  }
  [[nodiscard]] double last_indentation_m() const override { return curves_.last_indentation_m(); }

 private:
  LawCurves curves_;
};

void require_positive_stiffness(double stiffness, const char* unit) {
  require(std::isfinite(stiffness) && stiffness > 0, "contact stiffness {} {} is not a positive number", stiffness,
          unit);
}

void require_finite(double indentation_m) {
  require(std::isfinite(indentation_m), "indentation {} m is not finite", indentation_m);
}

LawHistory turned_at(const ContactLaw::Model& model, double indentation_m, double dissipated_J) {
  return {indentation_m, model.loading(indentation_m).force_N, dissipated_J, Path::unloading};
}

/// What loading up to αm has cost: its work less what unloading gives back.
double loading_loss(const ContactLaw::Model& model, double largest_indentation_m) {
  if (largest_indentation_m == 0) return 0;
  const LawHistory turned = turned_at(model, largest_indentation_m, 0);
  return model.loading(largest_indentation_m).energy_J - model.path(largest_indentation_m, turned).energy_J;
}

/// What arriving at αm costs after a reload: its work less what unloading gives back.
double reloading_loss(const ContactLaw::Model& model, LawHistory history) {
  if (history.path == Path::unloading) return 0;
  const double work = model.path(history.largest_indentation_m, history).energy_J;
  history.path = Path::unloading;
  return work - model.path(history.largest_indentation_m, history).energy_J;
}

}  // namespace

ContactLaw ContactLaw::rigid() { return ContactLaw(nullptr); }

ContactLaw ContactLaw::linear(double stiffness_N_per_m) {
  require_positive_stiffness(stiffness_N_per_m, "N/m");
  return ContactLaw(std::make_shared<Linear>(stiffness_N_per_m));
}

ContactLaw ContactLaw::hertz(double stiffness_N_per_m32) {
  require_positive_stiffness(stiffness_N_per_m32, "N/m^1.5");
  return ContactLaw(std::make_shared<Hertz>(stiffness_N_per_m32));
}

ContactLaw ContactLaw::tan_sun(double stiffness_N_per_m32, double permanent_beta, double critical_indentation_m) {
  require_positive_stiffness(stiffness_N_per_m32, "N/m^1.5");
  require(permanent_beta >= 0 && permanent_beta < 1, "beta {} of the permanent indentation is outside [0, 1)",
          permanent_beta);
  require(std::isfinite(critical_indentation_m) && critical_indentation_m >= 0,
          "critical indentation {} m is not a number from 0", critical_indentation_m);
  return ContactLaw(std::make_shared<TanSun>(stiffness_N_per_m32, permanent_beta, critical_indentation_m));
}

ContactLaw ContactLaw::table(LawTable table) { return ContactLaw(std::make_shared<Table>(std::move(table))); }

double ContactLaw::largest_possible_indentation_m() const {
  return is_rigid() ? std::numeric_limits<double>::infinity() : model_->last_indentation_m();
}

double ContactLaw::force(double indentation_m, const LawHistory& history) const {
  require(!is_rigid(), "a rigid contact has no force at an indentation (its force is a constraint's)");
  require_finite(indentation_m);
  if (indentation_m <= permanent_indentation(history)) return 0;
  return indentation_m < history.largest_indentation_m ? model_->path(indentation_m, history).force_N
                                                       : model_->loading(indentation_m).force_N;
}

double ContactLaw::tangent(double indentation_m, const LawHistory& history) const {
  require(!is_rigid(), "a rigid contact has no tangent");
  require_finite(indentation_m);
  if (indentation_m < permanent_indentation(history)) return 0;
  return indentation_m < history.largest_indentation_m ? model_->path(indentation_m, history).tangent_N_per_m
                                                       : model_->loading(indentation_m).tangent_N_per_m;
}

double ContactLaw::stored_energy(double indentation_m, const LawHistory& history) const {
  require_finite(indentation_m);
  if (is_rigid() || indentation_m <= permanent_indentation(history)) return 0;
  return indentation_m < history.largest_indentation_m
             ? model_->path(indentation_m, history).energy_J
             : model_->path(indentation_m, turned_at(*model_, indentation_m, 0)).energy_J;
}

double ContactLaw::permanent_indentation(const LawHistory& history) const {
  return is_rigid() ? 0 : model_->permanent_indentation_m(history.largest_indentation_m);
}

LawHistory ContactLaw::advanced(const LawHistory& history, double indentation_m) const {
  require_finite(indentation_m);
  if (is_rigid()) return history;
  if (history.largest_indentation_m > 0 && indentation_m <= permanent_indentation(history)) {
    LawHistory opened = history;
    opened.path = Path::reloading;
    return opened;
  }
  if (indentation_m <= 0 || indentation_m < history.largest_indentation_m) return history;
  const double loss = reloading_loss(*model_, history) +
                      (loading_loss(*model_, indentation_m) - loading_loss(*model_, history.largest_indentation_m));
  return turned_at(*model_, indentation_m, history.dissipated_J + loss);
}

}  // namespace impulse
