#pragma once

#include "impulse/contact/force_history.hpp"
#include "impulse/contact/modal_history.hpp"
#include "impulse/response/response.hpp"
#include "lib/model/modal_model.hpp"

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

namespace impulse {

/// A body by its sampled response or by its modes; what it refers to must outlive it.
using ResponseReference = std::reference_wrapper<const Response>;
using ModesReference = std::reference_wrapper<const ModalModel>;
using ContactBody = std::variant<ResponseReference, ModesReference>;

[[nodiscard]] std::size_t contact_count(const ContactBody& body);

/// U_ij(0+) [m/N].
[[nodiscard]] double residual_flexibility(const ContactBody& body, std::size_t i, std::size_t j);

/// Where a contact meets a body: which of the body's contacts.
struct ContactSide {
  std::size_t body;
  std::size_t contact;
};

/// A contact presses body `first` at its side and pushes body `second`.
struct Joint {
  ContactSide first;
  ContactSide second;
};

/// Contacts of two bodies, the i-th of one with the i-th of the other, or of a row of bodies, the exit of each with the
/// entry of the next. @throws std::invalid_argument if the numbers of contacts do not fit.
[[nodiscard]] std::vector<Joint> joints_of(const std::vector<ContactBody>& bodies);

/// History of the contacts of several bodies: a contact gets what both its bodies give. Sampled responses are added up
/// and convolved, bodies given by modes advance them. Verified by: tests/impulse/modal_history.test.cpp
class BodiesHistory final : public ForceHistory {
 public:
  /// `observer`, if any, hears now and then what part of the steps is done, 0 to 1.
  BodiesHistory(const std::vector<ContactBody>& bodies, const std::vector<Joint>& joints, const UniformGrid& grid,
                std::function<void(double)> observer);

  [[nodiscard]] std::size_t contact_count() const override { return joints_.size(); }
  [[nodiscard]] double within_step(std::size_t i, std::size_t j) const override;
  [[nodiscard]] double past(std::size_t i) const override;
  void push(std::span<const double> forces) override;

  /// Mean velocity into a body at one of its contacts over each step, once all steps were pushed. `mean_forces` are
  /// those, joint by joint; `forces` the same at the samples, from which a residual flexibility takes its part R ΔF.
  [[nodiscard]] std::vector<double> velocity_into(const ContactSide& at,
                                                  const std::vector<std::vector<double>>& mean_forces,
                                                  const std::vector<std::vector<double>>& forces) const;

 private:
  /// A body that advances its modes, and what past forces gave it at its contacts in each step.
  struct ModalBody {
    ModalBody(const ModalModel& modes, const UniformGrid& grid);
    ModalHistory history;
    std::vector<double> forces;
    std::vector<std::vector<double>> past;
  };
  void add_sampled_weights();
  [[nodiscard]] std::vector<const std::vector<double>*> of_body(
      std::size_t body, const std::vector<std::vector<double>>& of_joints) const;
  [[nodiscard]] std::vector<double> sampled_velocity(const Response& body, const ContactSide& at,
                                                     const std::vector<const std::vector<double>*>& forces) const;
  [[nodiscard]] std::vector<double> modal_velocity(const ModalBody& body, const ContactSide& at,
                                                   const std::vector<const std::vector<double>*>& forces) const;

  const std::vector<ContactBody>& bodies_;
  const std::vector<Joint>& joints_;
  UniformGrid grid_;
  std::function<void(double)> observer_;
  std::optional<ConvolutionHistory> sampled_;      ///< of the joints; none if all bodies have modes
  std::vector<std::unique_ptr<ModalBody>> modal_;  ///< of each body; null if it is sampled
  std::size_t steps_ = 0;
};

}  // namespace impulse
