/*
 * taut for C++17: the functions of taut.h as classes that free themselves, with exceptions and views. Header only: it
 * calls the C interface and nothing else.
 *
 *     std::vector<double> xyz;              // or float, or std::array<double, 3>, or any contiguous container
 *     std::vector<int> corners;             // or another integer, or std::array<int, 3>
 *     taut::Mesh mesh(xyz, corners);
 *
 *     taut::HeatSolver heat(mesh, taut::TimeStep::mean_edge().times(2));
 *     std::vector<double> near = heat.field(0).distances();           // from vertex 0
 *
 *     taut::ExactField field = taut::ExactSolver(mesh).field(std::array{0, 17});
 *     std::vector<float> buffer(mesh.vertex_count());
 *     field.distances(buffer);                                        // fills memory of yours
 *     taut::Curves path = field.paths(5);
 *
 * What a function does, costs and accepts is told in taut.h; here each names the C function that it calls.
 *
 * Handles can be moved and not copied. One that was moved from, given to a call, is an error of that call. Handles are
 * immutable, so any number of threads may use one at once.
 *
 * Every failure is a taut::Error. Structs and enums of numbers are those of C, with the size of structs already set.
 *
 * taut/openmesh.hpp, taut/cgal.hpp and taut/eigen.hpp make a Mesh of another library's, by make_mesh, and let its handles,
 * properties and vectors stand wherever a View is asked for.
 */
#ifndef TAUT_HPP
#define TAUT_HPP

#if (defined(_MSVC_LANG) ? _MSVC_LANG : __cplusplus) < 201703L
#error "taut.hpp needs C++17"
#endif

#include <taut.h>

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <exception>
#include <functional>
#include <iterator>
#include <limits>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <type_traits>
#include <utility>
#include <vector>

namespace taut {

/// What `nearest_sources`, `component_of` and `farthest_points` say where there is none, in 32 unsigned bits.
inline constexpr std::uint32_t none = (std::numeric_limits<std::uint32_t>::max)();

/// Version of the library that runs, as "0.1.0". C: taut_version.
inline const char *version() noexcept { return taut_version(); }

/// Binary interface of the library that runs, to be compared to TAUT_ABI. C: taut_abi.
inline std::uint32_t abi() noexcept { return taut_abi(); }

/// Name of a status, as "invalid mesh". C: taut_status_name.
inline const char *status_name(taut_status status) noexcept { return taut_status_name(status); }

// ---------------------------------------------------------------------------------------------------------- Errors

/// The failure of a call; what() is the message for people.
class Error : public std::runtime_error {
public:
    Error(taut_status status, taut_reason reason, taut_element element, std::uint64_t index, const std::string &message)
        : std::runtime_error(message), status_(status), reason_(reason), element_(element), index_(index) {}

    /// The coarse class, TAUT_STATUS_...
    taut_status status() const noexcept { return status_; }
    /// What went wrong, TAUT_REASON_...
    taut_reason reason() const noexcept { return reason_; }
    /// What kind of element is at fault, TAUT_ELEMENT_...
    taut_element element() const noexcept { return element_; }
    /// Which one, counted from 0 (a line from 1); 0 where there is none.
    std::uint64_t index() const noexcept { return index_; }

private:
    taut_status status_;
    taut_reason reason_;
    taut_element element_;
    std::uint64_t index_;
};

/// Throws what the last failed C call on this thread ran into, unless `status` is TAUT_STATUS_OK. C: taut_last_error.
inline void check(taut_status status) {
    if (status == TAUT_STATUS_OK) return;
    taut_error error = {};
    error.struct_size = sizeof error;
    const char *message = taut_last_error(&error);
    throw Error(status, error.reason, error.element, error.index, message);
}

// ----------------------------------------------------------------------------------------------------------- Views

/// Stands for real numbers: `float` or `double`.
struct Real {};
/// Stands for indices: integers of 32 or 64 bits, or unsigned ones of 16. Negative ones are an error of the call.
struct Index {};

/// Tells how a T holds a row of numbers: their type `Scalar`, how many (`width`), and where (`data`). For another type of
/// points or of handles, specialise it; the first number of a T must lie in its memory, the others right behind.
template <class T, class = void>
struct Row {};

template <class T>
struct Row<T, std::enable_if_t<std::is_arithmetic_v<T> && !std::is_same_v<T, bool>>> {
    using Scalar = T;
    static constexpr std::size_t width = 1;
    static const T *data(const T &number) noexcept { return &number; }
};

template <class T, std::size_t N>
struct Row<std::array<T, N>> {
    using Scalar = T;
    static constexpr std::size_t width = N;
    static const T *data(const std::array<T, N> &row) noexcept { return row.data(); }
};

template <class T, std::size_t N>
struct Row<T[N]> {
    using Scalar = T;
    static constexpr std::size_t width = N;
    static const T *data(const T (&row)[N]) noexcept { return row; }
};

/// The width of rows that are as wide as they have to be.
inline constexpr std::size_t any_width = (std::numeric_limits<std::size_t>::max)();

/// Rows of numbers in memory: `count` rows, `stride` bytes apart, of `width` numbers each.
template <class Scalar>
struct Rows {
    Scalar *data;
    std::size_t count;
    std::size_t stride;
    std::size_t width;
};

namespace detail {

/// The taut_type of a C++ type, 0 if there is none.
template <class T>
constexpr taut_type type_of() {
    if (std::is_same_v<T, float>) return TAUT_TYPE_F32;
    if (std::is_same_v<T, double>) return TAUT_TYPE_F64;
    if (!std::is_integral_v<T> || std::is_same_v<T, bool>) return 0;
    if (sizeof(T) == 2 && std::is_unsigned_v<T>) return TAUT_TYPE_U16;
    if (sizeof(T) == 4) return std::is_unsigned_v<T> ? TAUT_TYPE_U32 : TAUT_TYPE_I32;
    if (sizeof(T) == 8) return std::is_unsigned_v<T> ? TAUT_TYPE_U64 : TAUT_TYPE_I64;
    return 0;
}

/// Whether a view of `Element` may be made of numbers of type `Scalar`, which is const where they cannot be written.
template <class Element, class Scalar>
constexpr bool fits() {
    using Number = std::remove_const_t<Scalar>;
    constexpr bool is_real = std::is_same_v<std::remove_const_t<Element>, Real>;
    return type_of<Number>() != 0 && std::is_floating_point_v<Number> == is_real &&
           (std::is_const_v<Element> || !std::is_const_v<Scalar>);
}

template <class T>
using RowScalar = typename Row<std::remove_const_t<T>>::Scalar;

template <class C>
using ElementOf = std::remove_pointer_t<decltype(std::data(std::declval<C &>()))>;

template <class T, class = void>
struct has_rows : std::false_type {};
template <class T>
struct has_rows<T, std::void_t<decltype(std::declval<const T &>().rows())>> : std::true_type {};

[[noreturn]] inline void bad_argument(taut_reason reason, const std::string &message) {
    throw Error(TAUT_STATUS_INVALID_ARGUMENT, reason, TAUT_ELEMENT_NONE, 0, message);
}

} // namespace detail

/// Tells where the rows of a container are: `Rows rows(C &)`. Contiguous containers have an element a row; of matrices
/// the header of their library knows more (taut/eigen.hpp). Specialise it for another container.
template <class C, class = void>
struct RowsOf {};

template <class C>
struct RowsOf<C, std::enable_if_t<!detail::has_rows<C>::value,
                                  std::void_t<decltype(std::size(std::declval<C &>())),
                                              detail::RowScalar<detail::ElementOf<C>>>>> {
    using Element = detail::ElementOf<C>;
    using Scalar = std::conditional_t<std::is_const_v<Element>, const detail::RowScalar<Element>,
                                      detail::RowScalar<Element>>;
    static Rows<Scalar> rows(C &container) {
        using Layout = Row<std::remove_const_t<Element>>;
        const std::size_t count = static_cast<std::size_t>(std::size(container));
        // The element may be written if `Scalar` is not const.
        Scalar *data = count == 0 ? nullptr : const_cast<Scalar *>(Layout::data(*std::data(container)));
        return {data, count, sizeof(Element), Layout::width};
    }
};

namespace detail {

template <class C, class = void>
struct is_container : std::false_type {};
template <class C>
struct is_container<C, std::void_t<decltype(RowsOf<C>::rows(std::declval<C &>()))>> : std::true_type {};

} // namespace detail

/// Rows of numbers in memory of yours: read by a call where Element is const, filled where it is not.
///
/// It is made of a contiguous container (std::vector, std::array, std::span, an array of C) of numbers, row after row, or
/// of rows (std::array, an array of C, what `Row` knows); of a pointer, the number of rows, and the bytes from one row
/// to the next; and, if it is read, of a single number. It is meant for parameters: it must not outlive what it is made of.
template <class Element>
class View {
    static constexpr bool is_input = std::is_const_v<Element>;
    static constexpr bool is_real = std::is_same_v<std::remove_const_t<Element>, Real>;
    template <class C>
    using ScalarOf = std::remove_pointer_t<decltype(RowsOf<C>::rows(std::declval<C &>()).data)>;

public:
    /// No rows.
    View() = default;

    /// A container that can be written to.
    template <class C, std::enable_if_t<detail::fits<Element, ScalarOf<C>>(), int> = 0>
    View(C &container) : View(RowsOf<C>::rows(container)) {}

    /// A container that is read, or whose elements are elsewhere, as those of std::span.
    template <class C, std::enable_if_t<detail::fits<Element, ScalarOf<const C>>(), int> = 0>
    View(const C &container) : View(RowsOf<const C>::rows(container)) {}

    /// `count` rows that begin at `data`, `stride` bytes apart; 0 if without a gap. As wide as the call asks for.
    template <class Scalar, std::enable_if_t<detail::fits<Element, Scalar>(), int> = 0>
    View(Scalar *data, std::size_t count, std::size_t stride = 0)
        : View(Rows<Scalar>{data, count, stride, any_width}) {}

    /// One number, a vertex or a level, or what `Row` knows as one.
    template <class T, class Scalar = typename Row<T>::Scalar,
              std::enable_if_t<is_input && Row<T>::width == 1 && !detail::is_container<const T>::value &&
                                   (detail::fits<Element, Scalar>() || (is_real && std::is_integral_v<Scalar>)), long> = 0>
    View(const T &number) : count_(1), width_(1), is_number_(true) {
        using Kept = std::conditional_t<is_real && std::is_integral_v<Scalar>, double, Scalar>;
        const Kept kept = static_cast<Kept>(*Row<T>::data(number));
        std::memcpy(number_, &kept, sizeof kept);
        stride_ = size_ = sizeof kept;
        type_ = detail::type_of<Kept>();
    }

    /// As C takes it, in rows of `width` numbers; a taut::Error if it has no such rows. Valid as long as this view.
    std::conditional_t<is_input, taut_input, taut_output> c(std::size_t width = 1) const {
        if (width_ == width || width_ == any_width) return {data(), count_, stride_, type_, 0};
        const bool is_flat = width_ == 1 && stride_ == size_;
        if (!is_flat || (width == 0 ? count_ != 0 : count_ % width != 0))
            detail::bad_argument(TAUT_REASON_BAD_ARGUMENT, std::to_string(count_) + " rows of " + std::to_string(width_) +
                                                               " numbers, where rows of " + std::to_string(width) +
                                                               " are asked for");
        return {data(), width == 0 ? 0 : count_ / width, width * size_, type_, 0};
    }

    /// How many bytes a number has.
    std::size_t number_size() const noexcept { return size_; }

private:
    using Pointer = std::conditional_t<is_input, const void *, void *>;

    template <class Scalar>
    explicit View(Rows<Scalar> rows)
        : data_(rows.data), count_(rows.count), stride_(rows.stride), width_(rows.width), size_(sizeof(Scalar)),
          type_(detail::type_of<std::remove_const_t<Scalar>>()) {}

    Pointer data() const noexcept {
        if constexpr (is_input)
            if (is_number_) return number_;
        return data_;
    }

    Pointer data_ = nullptr;
    std::size_t count_ = 0;
    std::size_t stride_ = 0;
    std::size_t width_ = any_width;
    std::size_t size_ = 0; // of a number, in bytes
    taut_type type_ = 0;
    bool is_number_ = false;
    alignas(8) unsigned char number_[8] = {};
};

namespace detail {

/// A copy of rows, for what may outlive them.
class Copied {
public:
    Copied() = default;
    template <class Element>
    explicit Copied(const View<Element> &view, std::size_t width = 1) : c_(view.c(width)) {
        const std::size_t row = width * view.number_size();
        const std::size_t stride = std::exchange(c_.stride, 0);
        if (c_.data == nullptr || c_.count == 0) return; // NULL is for C to judge
        if (c_.count > (std::numeric_limits<std::size_t>::max)() / row)
            throw Error(TAUT_STATUS_TOO_LARGE, TAUT_REASON_TOO_MANY_ELEMENTS, TAUT_ELEMENT_NONE, 0, "too many rows");
        bytes_.resize(c_.count * row);
        const unsigned char *from = static_cast<const unsigned char *>(c_.data);
        for (std::size_t i = 0; i < c_.count; i++)
            std::memcpy(&bytes_[i * row], from + i * (stride == 0 ? row : stride), row);
    }

    std::size_t count() const noexcept { return c_.count; }

    /// Valid as long as this.
    taut_input c() const noexcept {
        taut_input c = c_;
        c.data = bytes_.empty() ? nullptr : bytes_.data();
        return c;
    }

private:
    std::vector<unsigned char> bytes_;
    taut_input c_ = {};
};

} // namespace detail

// --------------------------------------------------------------------------------------------------------- Control

/// Watches, limits and cancels long calls, from any thread. Use a new one for each call, or for calls that share a limit.
class Control {
public:
    /// Without a callback. C: taut_control_new.
    Control() : Control(std::function<void(double)>()) {}

    /// `callback` is told the progress, in [0, 1], on the thread of the call, and may use the control, say to cancel. If it
    /// throws, the work is cancelled, the exception comes out of the call, and the callback is not called again.
    /// C: taut_control_set_callback.
    explicit Control(std::function<void(double)> callback) : state_(std::make_unique<State>()) {
        check(taut_control_new(&state_->control));
        if (!callback) return;
        state_->callback = std::move(callback);
        check(taut_control_set_callback(state_->control, &State::tell, state_.get()));
    }

    /// C: taut_control_cancel. From any thread.
    void cancel() const noexcept { taut_control_cancel(get()); }
    /// C: taut_control_is_cancelled.
    bool is_cancelled() const noexcept { return taut_control_is_cancelled(get()); }
    /// The share that is done, in [0, 1]. C: taut_control_progress.
    double progress() const noexcept { return taut_control_progress(get()); }
    /// Of time from now; 0 means none. C: taut_control_set_time_limit.
    void set_time_limit(std::chrono::duration<double> limit) const {
        check(taut_control_set_time_limit(get(), limit.count()));
    }
    /// The least time between two calls of the callback; 0 means to call it at each check. C: taut_control_set_callback_interval.
    void set_callback_interval(std::chrono::duration<double> interval) const {
        check(taut_control_set_callback_interval(get(), interval.count()));
    }
    /// 0 means none. C: taut_control_set_memory_limit.
    void set_memory_limit(std::size_t bytes) const { check(taut_control_set_memory_limit(get(), bytes)); }

    /// The handle of C, still owned by this; NULL once moved from.
    const taut_control *get() const noexcept { return state_ ? state_->control : nullptr; }

    /// Throws what the callback threw on this thread, if it did. Calls of this header do so themselves.
    void rethrow() const {
        if (state_) state_->rethrow();
    }

private:
    // What C points to while the control moves.
    struct State {
        State() = default;
        State(const State &) = delete;
        State &operator=(const State &) = delete;
        ~State() { taut_control_free(control); }

        static int tell(double progress, void *user) noexcept {
            State &state = *static_cast<State *>(user);
            // No other thread is in here: the library runs a callback once at a time.
            if (state.has_thrown) return 1;
            try {
                state.callback(progress);
                return 0;
            } catch (...) {
                const std::lock_guard<std::mutex> lock(state.mutex);
                state.has_thrown = true;
                state.thrown = std::current_exception();
                state.thrower = std::this_thread::get_id();
                return 1;
            }
        }

        void rethrow() {
            std::exception_ptr exception;
            {
                const std::lock_guard<std::mutex> lock(mutex);
                if (thrower != std::this_thread::get_id()) return; // that of another call with the same control
                exception = std::exchange(thrown, nullptr);
            }
            if (exception) std::rethrow_exception(exception);
        }

        taut_control *control = nullptr;
        std::function<void(double)> callback;
        bool has_thrown = false;
        std::mutex mutex; // guards the next two
        std::exception_ptr thrown;
        std::thread::id thrower;
    };

    std::unique_ptr<State> state_;
};

namespace detail {

/// What a call of C gets for a control, which need not be.
inline const taut_control *get(const Control *control) {
    if (control && !control->get()) bad_argument(TAUT_REASON_NULL_POINTER, "the control was moved from");
    return control ? control->get() : nullptr;
}

/// The result of a call that may have run the callback of `control`, whose exception comes first.
inline void check(taut_status status, const Control *control) {
    if (control) control->rethrow();
    taut::check(status);
}

/// Owns a handle of C.
template <class T, void (*Free)(T *)>
class Handle {
public:
    /// The handle of C, still owned by this; NULL once moved from.
    const T *get() const noexcept { return owner_.get(); }

protected:
    /// What `make(T **)` makes; `control` is the one that it uses.
    template <class Make>
    explicit Handle(const Make &make, const Control *control = nullptr) {
        T *made = nullptr;
        const taut_status status = make(&made);
        owner_.reset(made);
        check(status, control);
    }

private:
    struct Deleter {
        void operator()(T *handle) const noexcept { Free(handle); }
    };
    std::unique_ptr<T, Deleter> owner_;
};

/// `count` rows that `fill` writes.
template <class T, class Fill>
std::vector<T> filled(std::size_t count, const Fill &fill) {
    std::vector<T> rows(count);
    fill(rows);
    return rows;
}

/// A struct of C with its size set.
template <class T>
T sized() {
    T value = {};
    value.struct_size = sizeof value;
    return value;
}

} // namespace detail

// --------------------------------------------------------------------------------------------------------- Options

/// The time step t of the heat flow: a formula times a factor, or a value. C: taut_time_step.
class TimeStep {
public:
    /// The default, mean_edge().
    TimeStep() = default;

    /// t = e², the square of the mean edge length (Eq. 1).
    static TimeStep mean_edge() { return TimeStep(TAUT_TIME_FORMULA_MEAN_EDGE); }
    /// t = s, the standard deviation of the edge lengths (Eq. 2).
    static TimeStep sigma() { return TimeStep(TAUT_TIME_FORMULA_SIGMA); }
    /// t = (e² + s) / 2 (Eq. 3).
    static TimeStep mean_sigma() { return TimeStep(TAUT_TIME_FORMULA_MEAN_SIGMA); }
    /// t = 1.01204 s - 0.0001 (Eq. 4).
    static TimeStep median_fit() { return TimeStep(TAUT_TIME_FORMULA_MEDIAN_FIT); }
    /// t = (e² + 1.01204 s - 0.0001) / 2 (Eq. 5).
    static TimeStep median_mean() { return TimeStep(TAUT_TIME_FORMULA_MEDIAN_MEAN); }
    /// t itself, positive, in mesh units squared.
    static TimeStep value(double t) {
        TimeStep step;
        step.c_.value = positive(t);
        return step;
    }

    /// m times as much, m > 0.
    TimeStep times(double m) const {
        TimeStep step = *this;
        if (c_.value != 0) step.c_.value = positive(c_.value * m);
        else step.c_.factor = positive((c_.factor == 0 ? 1 : c_.factor) * m);
        return step;
    }
    /// The formula evaluated in the mesh's own units, not at the size of the paper's meshes.
    TimeStep raw() const {
        TimeStep step = *this;
        step.c_.scale = TAUT_TIME_SCALE_RAW;
        return step;
    }

    /// As C takes it.
    const taut_time_step &c() const noexcept { return c_; }

private:
    explicit TimeStep(taut_time_formula formula) { c_.formula = formula; }

    // 0 is not passed on to C, which would take the default.
    static double positive(double number) {
        if (!(number > 0)) detail::bad_argument(TAUT_REASON_BAD_TIME_STEP, "the time step is not positive");
        return number;
    }

    taut_time_step c_ = {};
};

/// Options of HeatSolver, all at their default; set what you need. C: taut_heat_options.
struct HeatOptions {
    HeatOptions(const TimeStep &step = {}) : time_step(step) {}

    /// The time step.
    TimeStep time_step;
    /// Heat at the mesh's boundary: from 0, no flow across (Neumann), to 1, kept at zero (Dirichlet).
    double boundary = 0;
    /// TAUT_LAPLACIAN_...
    taut_laplacian laplacian = TAUT_LAPLACIAN_INTRINSIC;
    /// TAUT_SHIFT_...
    taut_shift shift = TAUT_SHIFT_PINNED;
    /// TAUT_SOLVER_...
    taut_solver solver = TAUT_SOLVER_SUPERNODAL;

    /// As C takes it.
    taut_heat_options c() const {
        taut_heat_options options = detail::sized<taut_heat_options>();
        options.time_step = time_step.c();
        options.boundary = boundary;
        options.laplacian = laplacian;
        options.shift = shift;
        options.solver = solver;
        return options;
    }
};

class Curves;

/// Where distances are measured from: vertices, points of the surface, curves on it, numbered in this order. It keeps copies.
/// C: taut_sources.
class Sources {
public:
    /// No sources.
    Sources() = default;

    /// Vertices: one, or a container of them, or whatever makes a View<const Index>.
    template <class V, std::enable_if_t<std::is_convertible_v<const V &, View<const Index>>, int> = 0>
    Sources(const V &vertices) : vertices_(View<const Index>(vertices)) {}

    /// Points as well: the triangles in which they lie, and rows of three weights of its corners.
    Sources with_points(View<const Index> faces, View<const Real> barycentrics) const {
        Sources sources = *this;
        sources.faces_ = detail::Copied(faces);
        sources.barycentrics_ = detail::Copied(barycentrics, 3);
        return sources;
    }
    /// Curves as well: such as isolines.
    Sources with_curves(const Curves &curves) const;
    /// Curves as well: rows as those of Curves.
    Sources with_curves(View<const Index> offsets, View<const Index> faces, View<const Real> barycentrics,
                        View<const Index> closed = {}) const {
        Sources sources = *this;
        sources.curve_offsets_ = detail::Copied(offsets);
        sources.curve_faces_ = detail::Copied(faces);
        sources.curve_barycentrics_ = detail::Copied(barycentrics, 3);
        sources.curve_closed_ = detail::Copied(closed);
        return sources;
    }
    /// A start distance for each source of all kinds, in mesh units.
    Sources with_offsets(View<const Real> offsets) const {
        Sources sources = *this;
        sources.offsets_ = detail::Copied(offsets);
        return sources;
    }

    /// How many sources of all kinds there are.
    std::size_t count() const noexcept {
        const std::size_t ends = curve_offsets_.count();
        return vertices_.count() + faces_.count() + (ends == 0 ? 0 : ends - 1);
    }

    /// As C takes it; valid as long as this.
    taut_sources c() const {
        taut_sources sources = detail::sized<taut_sources>();
        sources.vertices = vertices_.c();
        sources.offsets = offsets_.c();
        sources.faces = faces_.c();
        sources.barycentrics = barycentrics_.c();
        sources.curve_offsets = curve_offsets_.c();
        sources.curve_faces = curve_faces_.c();
        sources.curve_barycentrics = curve_barycentrics_.c();
        sources.curve_closed = curve_closed_.c();
        return sources;
    }

private:
    detail::Copied vertices_, offsets_, faces_, barycentrics_;
    detail::Copied curve_offsets_, curve_faces_, curve_barycentrics_, curve_closed_;
};

/// Places that are asked about: vertices, then points of the surface. It keeps copies. C: taut_targets.
class Targets {
public:
    /// Every vertex of the mesh.
    Targets() = default;

    /// Vertices: one, or a container of them, or whatever makes a View<const Index>.
    template <class V, std::enable_if_t<std::is_convertible_v<const V &, View<const Index>>, int> = 0>
    Targets(const V &vertices) : is_every_vertex_(false), vertices_(View<const Index>(vertices)) {}

    /// Points as well, or alone if no vertices were given: as for Sources.
    Targets with_points(View<const Index> faces, View<const Real> barycentrics) const {
        Targets targets = *this;
        targets.is_every_vertex_ = false;
        targets.faces_ = detail::Copied(faces);
        targets.barycentrics_ = detail::Copied(barycentrics, 3);
        return targets;
    }

    /// Whether every vertex is meant.
    bool is_every_vertex() const noexcept { return is_every_vertex_; }
    /// How many places were given; 0 for every vertex.
    std::size_t count() const noexcept { return vertices_.count() + faces_.count(); }

    /// As C takes it; valid as long as this. Every vertex is a NULL pointer there.
    taut_targets c() const {
        taut_targets targets = detail::sized<taut_targets>();
        targets.vertices = vertices_.c();
        targets.faces = faces_.c();
        targets.barycentrics = barycentrics_.c();
        return targets;
    }

private:
    bool is_every_vertex_ = true;
    detail::Copied vertices_, faces_, barycentrics_;
};

namespace detail {

/// What a call of C gets for targets: a pointer, which is NULL for every vertex.
class TargetsPointer {
public:
    explicit TargetsPointer(const Targets &targets) : c_(targets.c()), is_null_(targets.is_every_vertex()) {}
    operator const taut_targets *() const noexcept { return is_null_ ? nullptr : &c_; }

private:
    taut_targets c_;
    bool is_null_;
};

} // namespace detail

/// Options of ExactSolver::field, all at their default; set what you need. C: taut_exact_options.
struct ExactOptions {
    /// The places whose distances are wanted; the work stops when all of these are final. None mean every vertex.
    Targets targets;
    /// The largest distance wanted; 0 means no limit.
    double radius = 0;
    /// Work that is cancelled or reaches a limit succeeds with what is final by then; else it fails.
    bool allow_partial = false;
    /// Keep what answers for points that are no vertices.
    bool keep_windows = false;
};

// ------------------------------------------------------------------------------------------------------------ Mesh

/// Statistics of edges and angles. C: taut_properties.
using Properties = taut_properties;

/// A mesh, checked once and then immutable: any soup of triangles. C: taut_mesh.
class Mesh : public detail::Handle<taut_mesh, taut_mesh_free> {
public:
    /// Rows of three coordinates, rows of three vertices. C: taut_mesh_new.
    Mesh(View<const Real> positions, View<const Index> triangles)
        : Mesh([&](taut_mesh **out) { return taut_mesh_new(positions.c(3), triangles.c(3), out); }) {}

    /// Face f has the corners from offsets[f] up to offsets[f + 1]. C: taut_mesh_new_polygons.
    static Mesh polygons(View<const Real> positions, View<const Index> offsets, View<const Index> corners) {
        return Mesh([&](taut_mesh **out) {
            return taut_mesh_new_polygons(positions.c(3), offsets.c(), corners.c(), out);
        });
    }
    /// From a file; the path in UTF-8. C: taut_mesh_read.
    static Mesh read(const std::string &path) {
        return Mesh([&](taut_mesh **out) { return taut_mesh_read(path.c_str(), out); });
    }
    /// From the content of a file, TAUT_FORMAT_... C: taut_mesh_read_bytes.
    static Mesh read_bytes(const void *data, std::size_t size, taut_format format) {
        return Mesh([&](taut_mesh **out) { return taut_mesh_read_bytes(data, size, format, out); });
    }
    /// The same triangles with the vertices in other places. C: taut_mesh_with_positions.
    Mesh with_positions(View<const Real> positions) const {
        return Mesh([&](taut_mesh **out) { return taut_mesh_with_positions(get(), positions.c(3), out); });
    }

    /// C: taut_mesh_vertex_count.
    std::size_t vertex_count() const noexcept { return taut_mesh_vertex_count(get()); }
    /// C: taut_mesh_triangle_count.
    std::size_t triangle_count() const noexcept { return taut_mesh_triangle_count(get()); }
    /// Triangles that repeat a vertex. C: taut_mesh_ignored_count.
    std::size_t ignored_count() const noexcept { return taut_mesh_ignored_count(get()); }

    /// C: taut_mesh_positions.
    void positions(View<Real> out) const { check(taut_mesh_positions(get(), out.c(3))); }
    std::vector<std::array<double, 3>> positions() const {
        return detail::filled<std::array<double, 3>>(vertex_count(), [&](View<Real> out) { positions(out); });
    }
    /// C: taut_mesh_triangles.
    void triangles(View<Index> out) const { check(taut_mesh_triangles(get(), out.c(3))); }
    std::vector<std::array<std::uint32_t, 3>> triangles() const {
        return detail::filled<std::array<std::uint32_t, 3>>(triangle_count(), [&](View<Index> out) { triangles(out); });
    }
    /// C: taut_mesh_ignored_triangles.
    void ignored_triangles(View<Index> out) const { check(taut_mesh_ignored_triangles(get(), out.c())); }
    std::vector<std::uint32_t> ignored_triangles() const {
        return detail::filled<std::uint32_t>(ignored_count(), [&](View<Index> out) { ignored_triangles(out); });
    }

    /// Where points of the surface lie in space. C: taut_mesh_point_positions.
    void point_positions(View<const Index> faces, View<const Real> barycentrics, View<Real> out) const {
        check(taut_mesh_point_positions(get(), faces.c(), barycentrics.c(3), out.c(3)));
    }
    std::vector<std::array<double, 3>> point_positions(View<const Index> faces, View<const Real> barycentrics) const {
        return detail::filled<std::array<double, 3>>(
            faces.c().count, [&](View<Real> out) { point_positions(faces, barycentrics, out); });
    }

    /// C: taut_mesh_properties.
    Properties properties() const {
        Properties properties = detail::sized<Properties>();
        check(taut_mesh_properties(get(), &properties));
        return properties;
    }
    /// The t that this mesh gets, in mesh units squared. C: taut_time_step_value.
    double time_step(const TimeStep &step = {}) const {
        double t = 0;
        check(taut_time_step_value(get(), step.c(), &t));
        return t;
    }

private:
    template <class Make>
    explicit Mesh(const Make &make) : Handle(make) {}
};

// ---------------------------------------------------------------------------------------------------------- Report

/// A connected part of a mesh. C: taut_component.
using Component = taut_component;
/// An interior angle of a triangle. C: taut_angle.
using Angle = taut_angle;

/// A chain of edges with one triangle.
struct BoundaryLoop {
    /// Its vertices; the first of a closed one is not repeated.
    std::vector<std::uint32_t> vertices;
    /// If not, it ends at edges of more than two triangles.
    bool is_closed;
};

/// The diagnosis of a mesh; nothing that it finds is an error. C: taut_report.
class MeshReport : public detail::Handle<taut_report, taut_report_free> {
public:
    using Indices = std::vector<std::uint32_t>;
    using Pairs = std::vector<std::array<std::uint32_t, 2>>;

    /// C: taut_report_new.
    explicit MeshReport(const Mesh &mesh)
        : Handle([&](taut_report **out) { return taut_report_new(mesh.get(), out); }), vertex_count_(mesh.vertex_count()) {}

    /// How many findings of a kind there are, TAUT_FINDING_... C: taut_report_count.
    std::size_t count(taut_finding finding) const noexcept { return taut_report_count(get(), finding); }

    /// C: taut_report_component.
    std::vector<Component> components() const {
        std::vector<Component> components(count(TAUT_FINDING_COMPONENTS), detail::sized<Component>());
        for (std::size_t i = 0; i < components.size(); i++) check(taut_report_component(get(), i, &components[i]));
        return components;
    }
    /// The component of each vertex; `none` where no triangle uses it. C: taut_report_component_of.
    void component_of(View<Index> out) const { check(taut_report_component_of(get(), out.c())); }
    Indices component_of() const {
        return detail::filled<std::uint32_t>(vertex_count_, [&](View<Index> out) { component_of(out); });
    }
    /// C: taut_report_boundary_vertices.
    std::vector<BoundaryLoop> boundary_loops() const {
        const Pairs sizes = pairs(TAUT_FINDING_BOUNDARY_LOOPS);
        std::size_t total = 0;
        for (const auto &[size, is_closed] : sizes) total += size;
        Indices vertices(total);
        check(taut_report_boundary_vertices(get(), View<Index>(vertices).c()));
        std::vector<BoundaryLoop> loops;
        auto begin = vertices.begin();
        for (const auto &[size, is_closed] : sizes) {
            const auto end = begin + static_cast<std::ptrdiff_t>(size);
            loops.push_back({Indices(begin, end), is_closed != 0});
            begin = end;
        }
        return loops;
    }
    /// The smallest and the largest angle. C: taut_report_angles.
    std::pair<Angle, Angle> angles() const {
        std::pair<Angle, Angle> angles;
        check(taut_report_angles(get(), &angles.first, &angles.second));
        return angles;
    }

    // Each lists what taut.h says of TAUT_FINDING_ and its name. C: taut_report_list.
    Indices nonorientable_components() const { return indices(TAUT_FINDING_NONORIENTABLE_COMPONENTS); }
    Pairs nonmanifold_edges() const { return pairs(TAUT_FINDING_NONMANIFOLD_EDGES); }
    Indices nonmanifold_vertices() const { return indices(TAUT_FINDING_NONMANIFOLD_VERTICES); }
    Pairs inconsistent_edges() const { return pairs(TAUT_FINDING_INCONSISTENT_EDGES); }
    Indices zero_area_faces() const { return indices(TAUT_FINDING_ZERO_AREA_FACES); }
    Indices repeated_index_faces() const { return indices(TAUT_FINDING_REPEATED_INDEX_FACES); }
    Pairs duplicate_faces() const { return pairs(TAUT_FINDING_DUPLICATE_FACES); }
    Pairs duplicate_vertices() const { return pairs(TAUT_FINDING_DUPLICATE_VERTICES); }
    Indices unreferenced_vertices() const { return indices(TAUT_FINDING_UNREFERENCED_VERTICES); }

private:
    Indices indices(taut_finding finding) const {
        return detail::filled<std::uint32_t>(
            count(finding), [&](View<Index> out) { check(taut_report_list(get(), finding, out.c())); });
    }
    Pairs pairs(taut_finding finding) const {
        return detail::filled<std::array<std::uint32_t, 2>>(
            count(finding), [&](View<Index> out) { check(taut_report_list(get(), finding, out.c(2))); });
    }

    std::size_t vertex_count_;
};

// ---------------------------------------------------------------------------------------------------------- Curves

/// Polylines on the surface: isolines, shortest paths, or paths of steepest descent. C: taut_curves.
class Curves : public detail::Handle<taut_curves, taut_curves_free> {
public:
    /// C: taut_curves_count.
    std::size_t count() const noexcept { return taut_curves_count(get()); }
    /// Points of all curves together. C: taut_curves_point_count.
    std::size_t point_count() const noexcept { return taut_curves_point_count(get()); }

    /// Curve i has the points from offsets[i] up to offsets[i + 1]. C: taut_curves_offsets.
    void offsets(View<Index> out) const { check(taut_curves_offsets(get(), out.c())); }
    std::vector<std::uint32_t> offsets() const {
        return detail::filled<std::uint32_t>(count() + 1, [&](View<Index> out) { offsets(out); });
    }
    /// C: taut_curves_positions.
    void positions(View<Real> out) const { check(taut_curves_positions(get(), out.c(3))); }
    std::vector<std::array<double, 3>> positions() const {
        return detail::filled<std::array<double, 3>>(point_count(), [&](View<Real> out) { positions(out); });
    }
    /// C: taut_curves_faces.
    void faces(View<Index> out) const { check(taut_curves_faces(get(), out.c())); }
    std::vector<std::uint32_t> faces() const {
        return detail::filled<std::uint32_t>(point_count(), [&](View<Index> out) { faces(out); });
    }
    /// C: taut_curves_barycentrics.
    void barycentrics(View<Real> out) const { check(taut_curves_barycentrics(get(), out.c(3))); }
    std::vector<std::array<double, 3>> barycentrics() const {
        return detail::filled<std::array<double, 3>>(point_count(), [&](View<Real> out) { barycentrics(out); });
    }
    /// 1 for a closed curve, else 0. C: taut_curves_closed.
    void closed(View<Index> out) const { check(taut_curves_closed(get(), out.c())); }
    std::vector<std::uint32_t> closed() const {
        return detail::filled<std::uint32_t>(count(), [&](View<Index> out) { closed(out); });
    }
    /// The level of each isoline, the target of each path. C: taut_curves_levels.
    void levels(View<Index> out) const { check(taut_curves_levels(get(), out.c())); }
    std::vector<std::uint32_t> levels() const {
        return detail::filled<std::uint32_t>(count(), [&](View<Index> out) { levels(out); });
    }
    /// The source at which each path ends, `none` where it ends at none. C: taut_curves_sources.
    void sources(View<Index> out) const { check(taut_curves_sources(get(), out.c())); }
    std::vector<std::uint32_t> sources() const {
        return detail::filled<std::uint32_t>(count(), [&](View<Index> out) { sources(out); });
    }

private:
    template <class Make>
    explicit Curves(const Make &make, const Control *control = nullptr) : Handle(make, control) {}

    friend class ExactField;
    friend class ExactSolver;
    friend Curves isolines(const Mesh &, View<const Real>, View<const Real>);
    friend Curves descent_paths(const Mesh &, View<const Real>, const Sources &, const Targets &, const Control *);
};

inline Sources Sources::with_curves(const Curves &curves) const {
    return with_curves(curves.offsets(), curves.faces(), curves.barycentrics(), curves.closed());
}

/// Up to `count` levels, spread evenly between the least and the greatest value. C: taut_even_levels.
inline std::vector<double> even_levels(const Mesh &mesh, View<const Real> values, std::size_t count) {
    std::vector<double> levels(count < TAUT_MAX_LEVELS ? count : TAUT_MAX_LEVELS);
    std::size_t written = 0;
    check(taut_even_levels(mesh.get(), values.c(), count, View<Real>(levels).c(), &written));
    levels.resize(written);
    return levels;
}

/// The multiples of `spacing` between the least and the greatest value. C: taut_spaced_levels.
inline std::vector<double> spaced_levels(const Mesh &mesh, View<const Real> values, double spacing) {
    std::vector<double> levels(TAUT_MAX_LEVELS);
    std::size_t written = 0;
    check(taut_spaced_levels(mesh.get(), values.c(), spacing, View<Real>(levels).c(), &written));
    levels.resize(written);
    return levels;
}

/// The lines along which a value per vertex takes given levels. C: taut_isolines_new.
inline Curves isolines(const Mesh &mesh, View<const Real> values, View<const Real> levels) {
    return Curves([&](taut_curves **out) { return taut_isolines_new(mesh.get(), values.c(), levels.c(), out); });
}

/// The paths along which a value per vertex falls steepest, from each target. C: taut_descent_paths_new.
inline Curves descent_paths(const Mesh &mesh, View<const Real> values, const Sources &sources = {},
                            const Targets &targets = {}, const Control *control = nullptr) {
    const taut_sources from = sources.c();
    const detail::TargetsPointer to(targets);
    return Curves(
        [&](taut_curves **out) {
            return taut_descent_paths_new(mesh.get(), values.c(), &from, to, detail::get(control), out);
        },
        control);
}

// ------------------------------------------------------------------------------------------------------------ Heat

/// What preparing the heat method did, and how long it took. C: taut_heat_report.
using HeatReport = taut_heat_report;
/// How well the systems of a field are solved. C: taut_heat_residuals.
using HeatResiduals = taut_heat_residuals;

/// The distances from one set of sources by the heat method. C: taut_heat_field.
class HeatField : public detail::Handle<taut_heat_field, taut_heat_field_free> {
public:
    /// Of every vertex, +inf where no source reaches. C: taut_heat_field_distances.
    void distances(View<Real> out) const { check(taut_heat_field_distances(get(), out.c())); }
    std::vector<double> distances() const {
        return detail::filled<double>(vertex_count_, [&](View<Real> out) { distances(out); });
    }
    /// Of every vertex, `none` where no source reaches. C: taut_heat_field_nearest_sources.
    void nearest_sources(View<Index> out) const { check(taut_heat_field_nearest_sources(get(), out.c())); }
    std::vector<std::uint32_t> nearest_sources() const {
        return detail::filled<std::uint32_t>(vertex_count_, [&](View<Index> out) { nearest_sources(out); });
    }
    /// C: taut_heat_field_nonpositive_heat.
    std::uint64_t nonpositive_heat() const noexcept { return taut_heat_field_nonpositive_heat(get()); }
    /// C: taut_heat_field_restarts.
    std::uint32_t restarts() const noexcept { return taut_heat_field_restarts(get()); }

private:
    friend class HeatSolver;
    template <class Make>
    HeatField(const Make &make, const Control *control, std::size_t vertex_count)
        : Handle(make, control), vertex_count_(vertex_count) {}

    std::size_t vertex_count_;
};

/// The heat method prepared for one mesh and one time step. C: taut_heat.
class HeatSolver : public detail::Handle<taut_heat, taut_heat_free> {
public:
    /// C: taut_heat_new.
    explicit HeatSolver(const Mesh &mesh, const HeatOptions &options = {}, const Control *control = nullptr)
        : HeatSolver(
              [&](taut_heat **out) {
                  const taut_heat_options c = options.c();
                  return taut_heat_new(mesh.get(), &c, detail::get(control), out);
              },
              control, mesh.vertex_count()) {}

    /// For another time step, sharing all that does not depend on it. C: taut_heat_with_time_step.
    HeatSolver with_time_step(const TimeStep &step, const Control *control = nullptr) const {
        return HeatSolver(
            [&](taut_heat **out) { return taut_heat_with_time_step(get(), step.c(), detail::get(control), out); }, control,
            vertex_count_);
    }
    /// For the same triangles in other places (Mesh::with_positions). C: taut_heat_with_mesh.
    HeatSolver with_mesh(const Mesh &mesh, const Control *control = nullptr) const {
        return HeatSolver(
            [&](taut_heat **out) { return taut_heat_with_mesh(get(), mesh.get(), detail::get(control), out); }, control,
            vertex_count_);
    }

    /// t in mesh units squared. C: taut_heat_time_step.
    double time_step() const noexcept { return taut_heat_time_step(get()); }
    /// C: taut_heat_report_of.
    HeatReport report() const {
        HeatReport report = detail::sized<HeatReport>();
        check(taut_heat_report_of(get(), &report));
        return report;
    }

    /// How well the systems of a field are solved. C: taut_heat_residuals_of.
    HeatResiduals residuals(const Sources &sources, const Control *control = nullptr) const {
        const taut_sources from = sources.c();
        HeatResiduals residuals = detail::sized<HeatResiduals>();
        detail::check(taut_heat_residuals_of(get(), &from, detail::get(control), &residuals), control);
        return residuals;
    }

    /// C: taut_heat_field_new.
    HeatField field(const Sources &sources, const Control *control = nullptr) const {
        const taut_sources from = sources.c();
        return HeatField(
            [&](taut_heat_field **out) { return taut_heat_field_new(get(), &from, detail::get(control), out); }, control,
            vertex_count_);
    }
    /// A row for each source, as long as there are vertices; 0 threads: as many as the machine has.
    /// C: taut_heat_distance_rows.
    void distance_rows(const Sources &sources, View<Real> out, std::size_t threads = 0,
                       const Control *control = nullptr) const {
        distance_rows(sources, View<const Index>(), out, threads, control);
    }
    /// Row after row.
    std::vector<double> distance_rows(const Sources &sources, std::size_t threads = 0,
                                      const Control *control = nullptr) const {
        return detail::filled<double>(sources.count() * vertex_count_,
                                      [&](View<Real> out) { distance_rows(sources, out, threads, control); });
    }
    /// A row for each set of sources: set i has those from set_offsets[i] up to set_offsets[i + 1].
    void distance_rows(const Sources &sources, View<const Index> set_offsets, View<Real> out, std::size_t threads = 0,
                       const Control *control = nullptr) const {
        const taut_sources from = sources.c();
        detail::check(taut_heat_distance_rows(get(), &from, set_offsets.c(), threads, detail::get(control),
                                               out.c(vertex_count_)),
                      control);
    }

private:
    template <class Make>
    HeatSolver(const Make &make, const Control *control, std::size_t vertex_count)
        : Handle(make, control), vertex_count_(vertex_count) {}

    std::size_t vertex_count_;
};

// ----------------------------------------------------------------------------------------------------------- Exact

/// The exact distances from one set of sources, and the shortest paths to them. C: taut_exact_field.
class ExactField : public detail::Handle<taut_exact_field, taut_exact_field_free> {
public:
    /// Of every vertex, or of given places; +inf where no source reaches. C: taut_exact_field_distances.
    void distances(View<Real> out) const { distances(Targets(), out); }
    void distances(const Targets &targets, View<Real> out) const {
        check(taut_exact_field_distances(get(), detail::TargetsPointer(targets), out.c()));
    }
    std::vector<double> distances(const Targets &targets = {}) const {
        return detail::filled<double>(count(targets), [&](View<Real> out) { distances(targets, out); });
    }
    /// Of every vertex, or of given places; `none` where no source reaches. C: taut_exact_field_nearest_sources.
    void nearest_sources(const Targets &targets, View<Index> out) const {
        check(taut_exact_field_nearest_sources(get(), detail::TargetsPointer(targets), out.c()));
    }
    std::vector<std::uint32_t> nearest_sources(const Targets &targets = {}) const {
        return detail::filled<std::uint32_t>(count(targets), [&](View<Index> out) { nearest_sources(targets, out); });
    }
    /// From each place back to its nearest source. C: taut_exact_field_paths.
    Curves paths(const Targets &targets = {}, const Control *control = nullptr) const {
        const detail::TargetsPointer to(targets);
        return Curves([&](taut_curves **out) { return taut_exact_field_paths(get(), to, detail::get(control), out); },
                      control);
    }
    /// C: taut_exact_field_final_radius.
    double final_radius() const noexcept { return taut_exact_field_final_radius(get()); }
    /// What ended the work early, TAUT_STATUS_OK if nothing did. C: taut_exact_field_interruption.
    taut_status interruption() const noexcept { return taut_exact_field_interruption(get(), nullptr); }
    /// How many windows crossed a triangle. C: taut_exact_field_windows.
    std::uint64_t windows() const noexcept { return taut_exact_field_windows(get()); }

private:
    friend class ExactSolver;
    template <class Make>
    ExactField(const Make &make, const Control *control, std::size_t vertex_count)
        : Handle(make, control), vertex_count_(vertex_count) {}

    std::size_t count(const Targets &targets) const {
        return targets.is_every_vertex() ? vertex_count_ : targets.count();
    }

    std::size_t vertex_count_;
};

/// The distances of what lies within a radius of each source: a sparse matrix in compressed rows.
/// C: taut_sparse_distances.
class SparseDistances : public detail::Handle<taut_sparse_distances, taut_sparse_distances_free> {
public:
    /// C: taut_sparse_distances_row_count.
    std::size_t row_count() const noexcept { return taut_sparse_distances_row_count(get()); }
    /// Entries of all rows together. C: taut_sparse_distances_count.
    std::size_t count() const noexcept { return taut_sparse_distances_count(get()); }

    /// Row i has the entries from offsets[i] up to offsets[i + 1]. C: taut_sparse_distances_offsets.
    void offsets(View<Index> out) const { check(taut_sparse_distances_offsets(get(), out.c())); }
    std::vector<std::uint64_t> offsets() const {
        return detail::filled<std::uint64_t>(row_count() + 1, [&](View<Index> out) { offsets(out); });
    }
    /// C: taut_sparse_distances_vertices.
    void vertices(View<Index> out) const { check(taut_sparse_distances_vertices(get(), out.c())); }
    std::vector<std::uint32_t> vertices() const {
        return detail::filled<std::uint32_t>(count(), [&](View<Index> out) { vertices(out); });
    }
    /// C: taut_sparse_distances_values.
    void values(View<Real> out) const { check(taut_sparse_distances_values(get(), out.c())); }
    std::vector<double> values() const {
        return detail::filled<double>(count(), [&](View<Real> out) { values(out); });
    }

private:
    friend class ExactSolver;
    template <class Make>
    SparseDistances(const Make &make, const Control *control) : Handle(make, control) {}
};

/// Vertices spread evenly over the surface.
struct FarthestPoints {
    /// `none` once no vertex is left.
    std::vector<std::uint32_t> vertices;
    /// How far each was from those before it.
    std::vector<double> distances;
};

/// A mesh prepared for exact distances. C: taut_exact.
class ExactSolver : public detail::Handle<taut_exact, taut_exact_free> {
public:
    /// C: taut_exact_new.
    explicit ExactSolver(const Mesh &mesh)
        : Handle([&](taut_exact **out) { return taut_exact_new(mesh.get(), out); }), vertex_count_(mesh.vertex_count()) {}

    /// C: taut_exact_field_new.
    ExactField field(const Sources &sources, const ExactOptions &options = {}, const Control *control = nullptr) const {
        const taut_sources from = sources.c();
        const detail::TargetsPointer to(options.targets);
        taut_exact_options c = detail::sized<taut_exact_options>();
        c.targets = to;
        c.radius = options.radius;
        c.allow_partial = options.allow_partial;
        c.keep_windows = options.keep_windows;
        return ExactField(
            [&](taut_exact_field **out) { return taut_exact_field_new(get(), &from, &c, detail::get(control), out); },
            control, vertex_count_);
    }
    /// A row for each source, as long as there are vertices; 0 threads: as many as the machine has.
    /// C: taut_exact_distance_rows.
    void distance_rows(const Sources &sources, View<Real> out, std::size_t threads = 0,
                       const Control *control = nullptr) const {
        distance_rows(sources, View<const Index>(), out, threads, control);
    }
    /// Row after row.
    std::vector<double> distance_rows(const Sources &sources, std::size_t threads = 0,
                                      const Control *control = nullptr) const {
        return detail::filled<double>(sources.count() * vertex_count_,
                                      [&](View<Real> out) { distance_rows(sources, out, threads, control); });
    }
    /// A row for each set of sources: set i has those from set_offsets[i] up to set_offsets[i + 1].
    void distance_rows(const Sources &sources, View<const Index> set_offsets, View<Real> out, std::size_t threads = 0,
                       const Control *control = nullptr) const {
        const taut_sources from = sources.c();
        detail::check(taut_exact_distance_rows(get(), &from, set_offsets.c(), threads, detail::get(control),
                                               out.c(vertex_count_)),
                      control);
    }
    /// The open curve through points in their order, to be a source: Sources().with_curves. C: taut_exact_curve_through.
    Curves curve_through(View<const Index> faces, View<const Real> barycentrics, const Control *control = nullptr) const {
        return Curves(
            [&](taut_curves **out) {
                return taut_exact_curve_through(get(), faces.c(), barycentrics.c(3), detail::get(control), out);
            },
            control);
    }
    /// A row for each source, of the vertices within the radius. C: taut_exact_distances_within.
    SparseDistances distances_within(const Sources &sources, double radius, std::size_t threads = 0,
                                     const Control *control = nullptr) const {
        const taut_sources from = sources.c();
        return SparseDistances(
            [&](taut_sparse_distances **out) {
                return taut_exact_distances_within(get(), &from, radius, threads, detail::get(control), out);
            },
            control);
    }
    /// `count` vertices, each the one farthest from the sources and all before it. C: taut_exact_farthest_points.
    void farthest_points(const Sources &sources, std::size_t count, View<Index> vertices, View<Real> distances,
                         const Control *control = nullptr) const {
        const taut_sources from = sources.c();
        detail::check(taut_exact_farthest_points(get(), &from, count, detail::get(control), vertices.c(), distances.c()),
                      control);
    }
    FarthestPoints farthest_points(const Sources &sources, std::size_t count, const Control *control = nullptr) const {
        FarthestPoints points{std::vector<std::uint32_t>(count), std::vector<double>(count)};
        farthest_points(sources, count, points.vertices, points.distances, control);
        return points;
    }

private:
    std::size_t vertex_count_;
};

// --------------------------------------------------------------------------------------------------- Closest points

/// Places of the surface, nearest to points in space: sources or targets as they stand, by with_points.
struct ClosestPoints {
    /// The triangle in which each lies.
    std::vector<std::uint32_t> faces;
    /// The weights of its corners.
    std::vector<std::array<double, 3>> barycentrics;
    /// How far it is from the point, straight.
    std::vector<double> distances;
};

/// A mesh prepared for questions of what is nearest to a point in space. C: taut_closest.
class Closest : public detail::Handle<taut_closest, taut_closest_free> {
public:
    /// C: taut_closest_new.
    explicit Closest(const Mesh &mesh)
        : Handle([&](taut_closest **out) { return taut_closest_new(mesh.get(), out); }) {}

    /// Rows of three coordinates in; an index, three weights, a distance out. C: taut_closest_points.
    void points(View<const Real> positions, View<Index> faces, View<Real> barycentrics, View<Real> distances,
                const Control *control = nullptr) const {
        detail::check(taut_closest_points(get(), positions.c(3), detail::get(control), faces.c(), barycentrics.c(3),
                                          distances.c()),
                      control);
    }
    ClosestPoints points(View<const Real> positions, const Control *control = nullptr) const {
        const std::size_t count = positions.c(3).count;
        ClosestPoints found{std::vector<std::uint32_t>(count), std::vector<std::array<double, 3>>(count),
                            std::vector<double>(count)};
        points(positions, found.faces, found.barycentrics, found.distances, control);
        return found;
    }
};

} // namespace taut

#endif // TAUT_HPP
