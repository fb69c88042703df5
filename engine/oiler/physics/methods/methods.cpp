// SPDX-License-Identifier: MIT
#include "oiler/physics/methods/methods.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "oiler/core/error.hpp"
#include "oiler/core/nearest.hpp"

namespace oiler {
namespace {

using Row = Tableau::Row;

constexpr Stage k(long double coefficient) { return {Move::kick, coefficient}; }
constexpr Stage d(long double coefficient) { return {Move::drift, coefficient}; }

constexpr Method splitting(std::string_view name, int order, int evaluations,
                           std::string_view source, const Splitting& rule) {
    return {.name = name,
            .order = order,
            .evaluations = evaluations,
            .symplectic = true,
            .rule = rule,
            .source = source};
}
/// A splitting that is the same backwards; `half` are its stages up to the middle one.
constexpr Method palindrome(std::string_view name, int order, int evaluations,
                            std::string_view source, std::initializer_list<Stage> half) {
    Method method = splitting(name, order, evaluations, source, Splitting::palindrome(half));
    method.symmetric = true;
    return method;
}
constexpr Method tableau(std::string_view name, int order, std::string_view source,
                         const Tableau& rule) {
    return {.name = name,
            .order = order,
            .evaluations = static_cast<int>(rule.count),
            .rule = rule,
            .source = source};
}

// Name, order, evaluations of the forces per step, source, rule; see Method.
constexpr std::array list{
    tableau("explicit_euler", 1, "Euler, Institutionum calculi integralis I, 1768, §650",
            Tableau{{}, {1}, {0}}),
    Method{.name = "semi_implicit_euler",
           .order = 1,
           .evaluations = 1,
           .symplectic = true,
           .rule = Splitting{k(1.0L), d(1.0L)},
           .source = "Fiedler, Integration Basics, 2004; symplectic: de Vogelaere 1956",
           .damping = Damping::in_kick},
    splitting("semi_implicit_euler_drift_kick", 1, 1, "de Vogelaere 1956", {d(1.0L), k(1.0L)}),
    Method{.name = "implicit_euler",
           .order = 1,
           .evaluations = 0,
           .rule = ImplicitStage{1},
           .source = "Hairer & Wanner, Solving Ordinary Differential Equations II, IV.1"},
    Method{.name = "implicit_midpoint",
           .order = 2,
           .evaluations = 0,
           .symplectic = true,
           .symmetric = true,
           .rule = ImplicitStage{0.5L},
           .source = "Hairer, Lubich & Wanner, Geometric Numerical Integration, II.1.1, VI.4"},
    palindrome("velocity_verlet", 2, 1,
               "Swope et al. 1982; leapfrog with a staggered start, Verlet 1967",
               {k(0.5L), d(1.0L)}),
    palindrome("position_verlet", 2, 1, "Verlet 1967; Tuckerman et al. 1990", {d(0.5L), k(1.0L)}),
    tableau("rk2_midpoint", 2, "Runge 1895", Tableau{{Row{1 / 2.0L}}, {0, 1}, {0, 1 / 2.0L}}),
    tableau("rk2_heun", 2, "Heun 1900", Tableau{{Row{1}}, {1 / 2.0L, 1 / 2.0L}, {0, 1}}),
    tableau("rk2_ralston", 2, "Ralston 1962",
            Tableau{{Row{2 / 3.0L}}, {1 / 4.0L, 3 / 4.0L}, {0, 2 / 3.0L}}),
    tableau("rk3_kutta", 3, "Kutta 1901, order 3",
            Tableau{{Row{1 / 2.0L}, Row{-1, 2}}, {1 / 6.0L, 2 / 3.0L, 1 / 6.0L}, {0, 1 / 2.0L, 1}}),
    tableau("rk4", 4, "Kutta 1901, the classic of order 4",
            Tableau{{Row{1 / 2.0L}, Row{0, 1 / 2.0L}, Row{0, 0, 1}},
                    {1 / 6.0L, 1 / 3.0L, 1 / 3.0L, 1 / 6.0L},
                    {0, 1 / 2.0L, 1 / 2.0L, 1}}),
    tableau("rk4_38", 4, "Kutta 1901, the 3/8 rule",
            Tableau{{Row{1 / 3.0L}, Row{-1 / 3.0L, 1}, Row{1, -1, 1}},
                    {1 / 8.0L, 3 / 8.0L, 3 / 8.0L, 1 / 8.0L},
                    {0, 1 / 3.0L, 2 / 3.0L, 1}}),
    splitting("mclachlan_atela2", 2, 2, "McLachlan & Atela 1992, order 2",
              {k(0.2928932188134524755991556L), d(0.7071067811865475244008444L),
               k(0.7071067811865475244008444L), d(0.2928932188134524755991556L)}),
    splitting("ruth3", 3, 3, "Ruth 1983",
              {k(0.2916666666666666666666667L), d(0.6666666666666666666666667L), k(0.75L),
               d(-0.6666666666666666666666667L), k(-0.04166666666666666666666667L), d(1.0L)}),
    splitting("mclachlan_atela3", 3, 3, "McLachlan & Atela 1992, order 3",
              {k(0.2683300957817599161775608L), d(0.9196615230173999L),
               k(-0.1879916187991598161775608L), d(-0.1879916187991598161775608L),
               k(0.9196615230173999L), d(0.2683300957817599161775608L)}),
    palindrome("forest_ruth4", 4, 3, "Forest & Ruth 1990",
               {d(0.6756035959798288170238439L), k(1.351207191959657634047688L),
                d(-0.1756035959798288170238439L), k(-1.702414383919315268095376L)}),
    palindrome("yoshida4_kdk", 4, 3, "Yoshida 1990, order 4, kick first",
               {k(0.6756035959798288170238439L), d(1.351207191959657634047688L),
                k(-0.1756035959798288170238439L), d(-1.702414383919315268095376L)}),
    palindrome("suzuki4_kdk", 4, 5, "Suzuki 1990, fractal of order 4",
               {k(0.207245385897187868571177L), d(0.4144907717943757371423541L),
                k(0.4144907717943757371423541L), d(0.4144907717943757371423541L),
                k(-0.1217361576915636057135311L), d(-0.6579630871775029485694163L)}),
    palindrome("pefrl", 4, 4, "Omelyan, Mryglod & Folk 2002, position version",
               {d(0.1786178958448091L), k(0.7123418310626054L), d(-0.06626458266981849L),
                k(-0.2123418310626054L), d(0.77529337365001878L)}),
    palindrome("vefrl", 4, 4, "Omelyan, Mryglod & Folk 2002, velocity version",
               {k(0.164498651557576L), d(0.52094333910398989L), k(1.235692651138917L),
                d(-0.02094333910398989L), k(-1.800382605392986L)}),
    splitting("mclachlan_atela4", 4, 4, "McLachlan & Atela 1992, order 4",
              {k(0.1344961992774310892L), d(0.5153528374311229364L), k(-0.2248198030794208058L),
               d(-0.085782019412973646L), k(0.7563200005156682911L), d(0.4415830236164665242L),
               k(0.3340036032863214255L), d(0.1288461583653841854L)}),
    splitting("calvo_sanz_serna4", 4, 4,
              "Calvo & Sanz-Serna 1993, all digits from their order conditions",
              {k(0.0617588581345955606820766L), d(0.2051776615409159635906561L),
               k(0.3389780265537824435542595L), d(0.4030212816052528549403401L),
               k(0.6147913071768033151088278L), d(-0.1209208763389487319858817L),
               k(-0.1405480146597190284832937L), d(0.5127219331927799134548856L),
               k(0.1250198227945377091381299L)}),
    palindrome("mclachlan_sb3a_4", 4, 4, "McLachlan 1995, SB3A, 4 stages",
               {d(0.18819521776883821787L), k(1.0L), d(-0.021528551102171551201L), k(-0.5L),
                d(0.666666666666666666662L)}),
    palindrome("mclachlan_sb3a_5", 4, 5, "McLachlan 1995, SB3A, 5 stages",
               {d(0.40518861839525227722L), k(-0.04109589041095890410958904L),
                d(-0.287144040816524089L), k(0.2881355932203389830508475L),
                d(0.38195542242127181178L), k(0.5059205943812398421174832L)}),
    palindrome(
        "blanes_moan_srkn6b", 4, 6, "Blanes & Moan 2002, SRKN 6 b",
        {k(0.0829844064174052L), d(0.245298957184271L), k(0.396309801498368L), d(0.60487266571108L),
         k(-0.0390563049223486L), d(-0.350171622895351L), k(0.1195241940131508L)}),
    splitting("mclachlan_atela5", 5, 6, "McLachlan & Atela 1992, order 5",
              {k(0.1193900292875672758L), d(0.33983962583911L), k(0.6989273703824752308L),
               d(-0.088601336903027329L), k(-0.1713123582716007754L), d(0.5858564768259621188L),
               k(0.401269502251353448L), d(-0.603039356536491888L), k(0.010705081848235984L),
               d(0.3235807965546976394L), k(-0.0589796254980311632L), d(0.4423637942197494587L)}),
    palindrome("yoshida6a_kdk", 6, 7, "Yoshida 1990, order 6, solution A",
               {k(0.3922568052387786319097488L), d(0.7845136104775572638194976L),
                k(0.5100434119184576987521454L), d(0.2355732133593581336847932L),
                k(-0.4710533854097564366308112L), d(-1.177679984178871006946416L),
                k(0.06875316825252010596891702L), d(1.31518632068391121888425L)}),
    palindrome("okunbor_skeel6", 6, 7, "Okunbor & Skeel 1994, method 13",
               {d(-1.0130879789171747298L), k(0.00016600692650009894L), d(1.187429573732542707L),
                k(-0.37962421426377360608L), d(-0.01833585209646059034L),
                k(0.68913741185181063674L), d(0.34399425728109261314L), k(0.3806415909709257408L)}),
    palindrome("kahan_li6_kdk", 6, 9, "Kahan & Li 1997, order 6, 9 stages",
               {k(0.1960807220036570696396253L), d(0.3921614440073141392792506L),
                k(0.3623802903983367889394996L), d(0.3325991367893594385997486L),
                k(-0.1868235178841399606051081L), d(-0.7062461725576393598099648L),
                k(-0.3120162881320442797892372L), d(0.08221359629355080023149045L),
                k(0.4403787936141903818152204L), d(0.7985439909348299633989503L)}),
    palindrome(
        "mclachlan6_s9_kdk", 6, 9, "McLachlan 1995, SS of order 6, 9 stages",
        {k(0.09335L), d(0.1867L), k(0.37109851185623919958L), d(0.55549702371247839916L),
         k(0.34248198631297687861L), d(0.12946694891347535806L), k(-0.356899337237129625245L),
         d(-0.84326562338773460855L), k(0.049968839067913547055L), d(0.94320330152356170266L)}),
    palindrome("blanes_moan_srkn11b", 6, 11, "Blanes & Moan 2002, SRKN 11 b",
               {k(0.0414649985182624L), d(0.123229775946271L), k(0.198128671918067L),
                d(0.290553797799558L), k(-0.0400061921041533L), d(-0.127049212625417L),
                k(0.0752539843015807L), d(-0.246331761062075L), k(-0.0115113874206879L),
                d(0.357208872795928L), k(0.2366699247869311L), d(0.20477705429147L)}),
    palindrome("blanes_moan_srkn14a", 6, 14, "Blanes & Moan 2002, SRKN 14 a",
               {d(0.0378593198406116L), k(0.09171915262446165L), d(0.102635633102435L),
                k(0.183983170005006L), d(-0.0258678882665587L), k(-0.05653436583288827L),
                d(0.314241403071447L), k(0.004914688774712854L), d(-0.130144459517415L),
                k(0.143761127168358L), d(0.106417700369543L), k(0.328567693746804L),
                d(-0.00879424312851058L), k(-0.196411466486454234L), d(0.20730506905689536L)}),
    palindrome("yoshida8d_kdk", 8, 15, "Yoshida 1990, order 8, solution D",
               {k(0.4574221231148957833743967L), d(0.9148442462297915667487935L),
                k(0.5842687913980014604474698L), d(0.253693336566211354146146L),
                k(-0.5955794501471969017742923L), d(-1.444852236860605157694731L),
                k(-0.8015464361143276664493987L), d(-0.1582406353680501752040668L),
                k(0.8899492511272379056875599L), d(1.938139137622525986579186L),
                k(-0.01123554767639241051422344L), d(-1.960610232975310807607633L),
                k(-0.9289051917917571834547591L), d(0.1027998493917964406981151L),
                k(0.9056264600895390126832472L), d(1.708453070787281584668379L)}),
    palindrome("mclachlan8_s15_kdk", 8, 15,
               "Suzuki & Umeno 1993, McLachlan 1995, order 8, 15 stages",
               {k(0.3708351821753064767241139L), d(0.7416703643506129534482278L),
                k(0.1662847692752906797254638L), d(-0.4091008258000315939973001L),
                k(-0.1091730577518966070217119L), d(0.1907547102962383799538763L),
                k(-0.1915538804099219433512557L), d(-0.5738624711160822666563877L),
                k(-0.1373991449062131714059621L), d(0.2990641813036559238444635L),
                k(0.3168445497744770538147108L), d(0.334624918245298183784958L),
                k(0.3249590053210323902085073L), d(0.3152930923967665966320567L),
                k(-0.2407974234780748786938661L), d(-0.7968879393529163540197888L)}),
    palindrome("kahan_li8_kdk", 8, 17, "Kahan & Li 1997, order 8, 17 stages",
               {k(0.06510124154444504043940881L), d(0.1302024830888900808788176L),
                k(0.345682732431999232720391L), d(0.5611629817751083845619644L),
                k(0.0858440095651305490769429L), d(-0.3894749626448472864080786L),
                k(-0.1153165280448458427559339L), d(0.1588419065551556008962107L),
                k(-0.1185309937890409882200104L), d(-0.3959038941332375773362315L),
                k(-0.1056821265774609351221995L), d(0.1845396409783157070918325L),
                k(0.2214570143323188771929058L), d(0.2583743876863220472939791L),
                k(0.2766930556478161730824727L), d(0.2950117236093102988709662L),
                k(-0.1552484051103621064139774L), d(-0.6055085338300345116989211L)}),
    Method{.name = "exact",
           .order = exact_order,
           .evaluations = 1,
           .symplectic = true,
           .symmetric = true,
           .rule = ExactFlow{},
           .source =
               "Hirsch & Smale, Differential Equations, Dynamical Systems, and Linear Algebra, 5"},
};

/// Names that contain the word, else the nearest name.
std::string remedy_for(std::string_view word) {
    constexpr std::size_t shortest = 3;
    constexpr int most = 4;
    std::vector<std::string_view> names;
    std::string containing;
    int count = 0;
    for (const Method& method : list) {
        names.push_back(method.name);
        if (word.size() < shortest || method.name.find(word) == std::string_view::npos) continue;
        if (++count > most) continue;
        containing.append(count == 1 ? "`" : " or `").append(method.name).append("`");
    }
    if (count > 0) return "; did you mean " + containing + "?";
    return did_you_mean(word, names);
}

}  // namespace

std::span<const Method> methods() { return list; }

const Method& find_method(std::string_view name) {
    for (const Method& method : list)
        if (method.name == name) return method;
    fail(Exit::usage, "method {}: no such method{}; `oiler methods` lists all", name,
         remedy_for(name));
}

std::string_view name_of(Damping damping) { return damping == Damping::in_kick ? "kick" : "drift"; }

std::optional<Damping> find_damping(std::string_view name) {
    for (const Damping damping : {Damping::in_kick, Damping::in_drift})
        if (name_of(damping) == name) return damping;
    return std::nullopt;
}

int evaluations_with(const Method& method, Damping damping) {
    const auto* const splitting = std::get_if<Splitting>(&method.rule);
    const bool shares = splitting && splitting->stages().front().move == Move::kick &&
                        splitting->stages().back().move == Move::kick;
    return method.evaluations + (shares && damping == Damping::in_kick ? 1 : 0);
}

int damped_order(const Method& method, Damping damping) {
    const bool split = std::holds_alternative<Splitting>(method.rule);
    return split && damping == Damping::in_kick ? 1 : method.order;
}

int dragged_order(const Method& method, Damping damping) {
    const bool split = std::holds_alternative<Splitting>(method.rule);
    return split ? std::min(2, damped_order(method, damping)) : method.order;
}

}  // namespace oiler
