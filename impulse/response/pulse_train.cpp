#include "impulse/response/pulse_train.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <queue>

namespace impulse {
namespace {

using Series = TruncatedSeries<double>;

enum class Direction : std::uint8_t { right, left };

struct Front {
  std::int64_t tick;  ///< of arrival
  std::uint32_t piece;
  Direction direction;
  Series velocity;
};

struct ArrivesLater {
  bool operator()(const Front& x, const Front& y) const {
    if (x.tick != y.tick) return x.tick > y.tick;
    if (x.piece != y.piece) return x.piece > y.piece;
    return x.direction > y.direction;
  }
};

bool same_place(const Front& x, const Front& y) {
  return x.tick == y.tick && x.piece == y.piece && x.direction == y.direction;
}

/// Small fronts on a lattice: one line of series per piece and direction.
class Lattice {
 public:
  Lattice(std::size_t piece_count, std::int64_t spacing, std::int64_t end)
      : spacing_(spacing), size_(static_cast<std::size_t>(end / spacing) + 4), lines_(2 * piece_count) {}

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] std::int64_t tick(std::size_t index) const { return spacing_ * static_cast<std::int64_t>(index); }
  [[nodiscard]] bool used() const { return used_; }

  void add(const Front& front) {
    used_ = true;
    std::vector<Series>& line = lines_[index_of(front.piece, front.direction)];
    if (line.empty()) line.resize(size_);
    const std::int64_t below = front.tick / spacing_;
    const double x = static_cast<double>(front.tick - below * spacing_) / static_cast<double>(spacing_);
    // Cubic Lagrange weights at -1, 0, 1, 2 for a point at x in [0, 1).
    const double weights[4] = {-x * (x - 1) * (x - 2) / 6, (x + 1) * (x - 1) * (x - 2) / 2, -(x + 1) * x * (x - 2) / 2,
                               (x + 1) * x * (x - 1) / 6};
    for (std::int64_t k = -1; k <= 2; ++k) {
      const auto at = static_cast<std::size_t>(below + k);
      if (at < size_) line[at] = line[at] + weights[k + 1] * front.velocity;
    }
  }
  [[nodiscard]] const Series* at(std::uint32_t piece, Direction direction, std::size_t index) const {
    const std::vector<Series>& line = lines_[index_of(piece, direction)];
    return line.empty() ? nullptr : &line[index];
  }

 private:
  static std::size_t index_of(std::uint32_t piece, Direction direction) {
    return 2 * std::size_t{piece} + (direction == Direction::left ? 1 : 0);
  }
  std::int64_t spacing_;
  std::size_t size_;
  std::vector<std::vector<Series>> lines_;
  bool used_ = false;
};

class Tracer {
 public:
  Tracer(const WaveLine& line, double duration_s, double step_s, double mu)
      : line_(line),
        tick_s_(duration_s * 0x1p-50),
        end_(std::int64_t{1} << 50),
        mu_(mu),
        lattice_(line.pieces.size(), lattice_spacing(step_s), end_) {
    const Series inverse_s = inverse_s_series<double>(mu);
    struck_ = struck_end(line.pieces.front(), inverse_s);
    far_ = far_reflection(line.pieces.back(), line.far_end, inverse_s);
    for (std::size_t i = 0; i + 1 < line.pieces.size(); ++i) {
      const WavePiece& a = line.pieces[i];
      const WavePiece& b = line.pieces[i + 1];
      joints_.push_back(joint(a.impedance_right, a.taper_right, b.impedance_left, b.taper_left, inverse_s));
    }
    // A front that takes twice the record never arrives; its ticks need not fit in an integer.
    for (const WavePiece& piece : line.pieces)
      travel_.push_back(std::llround(std::min(piece.travel_time_s, 2 * duration_s) / tick_s_));
  }

  PulseTrain trace() {
    train_.mu_per_s = mu_;
    train_.at_struck_end.push_back({0.0, struck_.source});
    depart(0, 0, Direction::right, struck_.source);
    while (!lattice_.used() && !fronts_.empty()) arrive(next_front());
    // What is on the lattice arrives later than the front that was put there, so starting from its first line is safe.
    for (std::size_t index = 0; lattice_.used() && index < lattice_.size(); ++index) {
      while (!fronts_.empty() && fronts_.top().tick <= lattice_.tick(index)) arrive(next_front());
      arrive_from_lattice(index);
    }
    return std::move(train_);
  }

 private:
  static constexpr std::size_t front_limit = 100000;

  std::int64_t lattice_spacing(double step_s) const {
    // A front must not land before the lattice line it started from: at least three spacings per piece. 2^19 lines
    // bound memory.
    double spacing = std::max(step_s / 8, 0x1p-19 * tick_s_ * static_cast<double>(end_));
    for (const WavePiece& piece : line_.pieces) spacing = std::min(spacing, piece.travel_time_s / 3);
    return std::max<std::int64_t>(1, std::llround(spacing / tick_s_));
  }

  Front next_front() {
    Front front = fronts_.top();
    fronts_.pop();
    while (!fronts_.empty() && same_place(front, fronts_.top())) {
      front.velocity = front.velocity + fronts_.top().velocity;
      fronts_.pop();
    }
    return front;
  }

  /// Size of a front against the first pulse 1/Z, the tails weighed by how far they decay within 1/μ.
  [[nodiscard]] double size_of(const Series& velocity) const {
    double scale = line_.pieces.front().impedance_left;
    double largest = 0;
    for (double coefficient : velocity.a) {
      largest = std::max(largest, std::abs(coefficient) * scale);
      if (mu_ == 0) break;
      scale /= mu_;
    }
    return largest;
  }

  void depart(std::int64_t tick, std::uint32_t piece, Direction direction, const Series& velocity) {
    const WavePiece& way = line_.pieces[piece];
    const double spread = direction == Direction::right ? way.spread : 1 / way.spread;
    const Front front{tick + travel_[piece], piece, direction, spread * velocity};
    if (front.tick > end_) return;
    const double size = size_of(front.velocity);
    if (size < 1e-18) return;  // below the rounding of the first pulse
    if (size < threshold_)
      lattice_.add(front);
    else
      fronts_.push(front);
    if (fronts_.size() > front_limit) threshold_ = std::max(1e-16, threshold_) * 2;
  }

  void arrive_from_lattice(std::size_t index) {
    for (std::uint32_t piece = 0; piece < line_.pieces.size(); ++piece)
      for (Direction direction : {Direction::right, Direction::left})
        if (const Series* velocity = lattice_.at(piece, direction, index); velocity != nullptr)
          if (size_of(*velocity) > 0) arrive({lattice_.tick(index), piece, direction, *velocity});
  }

  void arrive(const Front& front) {
    const std::uint32_t last = static_cast<std::uint32_t>(line_.pieces.size()) - 1;
    const double time = tick_s_ * static_cast<double>(front.tick);
    if (front.direction == Direction::left && front.piece == 0) {
      const Series reflected = struck_.reflection * front.velocity;
      train_.at_struck_end.push_back({time, front.velocity + reflected});
      depart(front.tick, 0, Direction::right, reflected);
    } else if (front.direction == Direction::right && front.piece == last) {
      const Series reflected = far_ * front.velocity;
      train_.at_far_end.push_back({time, front.velocity + reflected});
      depart(front.tick, last, Direction::left, reflected);
    } else if (front.direction == Direction::right) {
      const Joint<Series>& here = joints_[front.piece];
      depart(front.tick, front.piece, Direction::left, here.reflection_left * front.velocity);
      depart(front.tick, front.piece + 1, Direction::right, here.transmission_right * front.velocity);
    } else {
      const Joint<Series>& here = joints_[front.piece - 1];
      depart(front.tick, front.piece - 1, Direction::left, here.transmission_left * front.velocity);
      depart(front.tick, front.piece, Direction::right, here.reflection_right * front.velocity);
    }
  }

  const WaveLine& line_;
  double tick_s_;
  std::int64_t end_;
  double mu_;
  Lattice lattice_;
  StruckEnd<Series> struck_;
  Series far_;
  std::vector<Joint<Series>> joints_;
  std::vector<std::int64_t> travel_;
  std::priority_queue<Front, std::vector<Front>, ArrivesLater> fronts_;
  double threshold_ = 0;
  PulseTrain train_;
};

}  // namespace

PulseTrain pulse_train(const WaveLine& line, double duration_s, double step_s, double mu_per_s) {
  return Tracer(line, duration_s, step_s, mu_per_s).trace();
}

}  // namespace impulse
